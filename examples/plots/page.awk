# A page with the verdicts and the pictures of script/demo, in HTML:
#   awk -v pictures="/ball.png .." -f page.awk VERDICTS README.md doc/*.md
# VERDICTS has a line for each scene: name, title, verdict and seconds between tabs. The captions of the pictures are
# their alternative texts in the pages of the manual.
BEGIN { FS = "\t" }

function plain(text) {
  gsub(/&/, "\\&amp;", text)
  gsub(/</, "\\&lt;", text)
  gsub(/>/, "\\&gt;", text)
  gsub(/"/, "\\&quot;", text)
  return text
}

NR == FNR {
  rows = rows "<tr" ($3 ~ /^FAILED/ ? " class=\"failed\"" : "") "><td><a href=\"" $1 ".txt\">" plain($2) \
    "</a></td><td>" plain($3) "</td><td class=\"time\">" $4 " s</td></tr>\n"
  next
}

/^!\[.*\]\([a-z_\/]*\.png\)$/ {
  name = $0
  sub(/.*\(/, "", name)
  sub(/.*\//, "", name)
  sub(/\)$/, "", name)
  text = substr($0, 3)
  sub(/\]\([^()]*\)$/, "", text)
  if (!(name in caption)) { caption[name] = text; page[name] = FILENAME }
}

END {
  print "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">"
  print "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
  print "<title>fuge: the demo</title>\n<style>"
  print "body { max-width: 52rem; margin: 2rem auto; padding: 0 1rem; font: 1rem/1.5 sans-serif; color: #222; }"
  print "h1, h2 { line-height: 1.2; }\na { color: #0072b2; }"
  print "table { border-collapse: collapse; width: 100%; }\ntd, th { text-align: left; padding: 0.3rem 0.6rem 0.3rem 0;"
  print "  border-bottom: 1px solid #e2e2e2; vertical-align: top; }\n.time { text-align: right; white-space: nowrap; }"
  print ".failed { background: #fbe3d6; }\nfigure { margin: 2.5rem 0; }\nimg { max-width: 100%; height: auto; }"
  print "figcaption { color: #444; }\n</style>\n</head>\n<body>\n<h1>fuge</h1>"
  print "<p>Contact of elastic bodies without friction: which points touch, and with which pressures. Each scene is"
  print "compared with a known answer; its name leads to its table.</p>\n<table>"
  print "<tr><th>scene</th><th>right values</th><th class=\"time\">time</th></tr>"
  printf "%s</table>\n<h2>Pictures</h2>\n", rows
  count = split(pictures, list, " ")
  for (k = 1; k <= count; k++) {
    file = substr(list[k], 2)
    name = file
    sub(/.*\//, "", name)
    print "<figure>\n<a href=\"" file "\"><img src=\"" file "\" width=\"800\" alt=\"" plain(caption[name]) "\"></a>"
    print "<figcaption>" plain(caption[name]) ". <a href=\"../../../" page[name] "\">" page[name] "</a></figcaption>"
    print "</figure>"
  }
  print "</body>\n</html>"
}
