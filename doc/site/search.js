// Search in the sections of all pages, from search_index.js: entries of address, title, place, text
// and the constants that the section declares or explains.
(function () {
  'use strict'
  const form = document.querySelector('main form')
  const field = form.querySelector('input')
  const status = document.getElementById('status')
  const list = document.getElementById('results')
  const MOST = 40

  // Letters without case and accents; a hyphen is a space, so that half-width is found as half width.
  function plain (text) {
    return text.toLowerCase().normalize('NFD').replace(/[\u0300-\u036f]/g, '').replace(/[-\u2010-\u2015]/g, ' ')
  }

  const entries = sections.map(([address, title, place, text, names]) =>
    ({ address, title, place, text, names, plainTitle: plain(title), plainText: plain(text) }))

  function count (text, word) {
    let found = 0
    for (let at = text.indexOf(word); at >= 0 && found < 20; at = text.indexOf(word, at + word.length)) found++
    return found
  }

  // How well an entry answers a query: names and titles before text, all words before some of them.
  function score (entry, query, words) {
    let sum = 0
    let hits = 0
    for (const word of words) {
      const inText = count(entry.plainText, word)
      const inTitle = entry.plainTitle.includes(word)
      if (inText || inTitle) hits++
      sum += Math.log2(1 + inText) * rare(entry) + (inTitle ? 8 / words.length : 0)
    }
    if (!hits) return 0
    if (hits < words.length) return sum * 0.01 * hits / words.length
    if (words.length > 1) {
      const phrases = count(entry.plainText, query) + count(entry.plainText, query.replace(/ /g, '_'))
      sum += 16 * Math.log2(1 + phrases) * rare(entry)
    }
    const titleWords = entry.plainTitle.split(/[\s,(]+/)
    if (titleWords[0] === query || entry.plainTitle === query) sum += 100
    else if (titleWords.includes(query)) sum += 60
    else if (titleWords.some(word => word.startsWith(query + '_'))) sum += 30
    else if (titleWords.some(word => word.startsWith(query))) sum += 20
    if (entry.plainTitle.includes(query)) sum += 10
    // Where a constant is declared or explained.
    if (entry.names.includes(query)) sum += 70
    const aside = entry.address.startsWith('page/file_') || entry.place.startsWith('The project')
    return (aside ? 0.5 : 1) * sum
  }

  // A word in a short section says more about it than one in a long one.
  function rare (entry) {
    return 1 / Math.sqrt(1 + entry.plainText.length / 4000)
  }

  // The part of the text around the first word that is found, with all words marked.
  function excerpt (entry, query, words) {
    let at = entry.plainText.indexOf(query)
    for (const word of words) if (at < 0) at = entry.plainText.indexOf(word)
    const start = at < 100 ? 0 : entry.text.indexOf(' ', at - 90) + 1
    const part = entry.text.slice(start, start + 260)
    const shown = document.createElement('p')
    if (start) shown.append('… ')
    let rest = 0
    const low = plain(part)
    while (low.length === part.length && rest < part.length) {
      const next = words.map(word => [low.indexOf(word, rest), word.length]).filter(pair => pair[0] >= 0)
        .sort((a, b) => a[0] - b[0] || b[1] - a[1])[0]
      if (!next) break
      shown.append(part.slice(rest, next[0]))
      const mark = document.createElement('mark')
      mark.textContent = part.slice(next[0], next[0] + next[1])
      shown.append(mark)
      rest = next[0] + next[1]
    }
    shown.append(part.slice(rest), start + 260 < entry.text.length ? ' …' : '')
    return shown
  }

  function show () {
    const query = plain(field.value).trim().replace(/\s+/g, ' ')
    const words = [...new Set(query.split(' '))].filter(word => word)
    list.replaceChildren()
    if (!words.length) {
      status.textContent = ''
      return
    }
    const found = entries.map(entry => [score(entry, query, words), entry]).filter(pair => pair[0] > 0)
      .sort((a, b) => b[0] - a[0])
    const whole = found.filter(pair => pair[0] > 1)
    const best = (whole.length ? whole : found).slice(0, MOST)
    for (const [, entry] of best) {
      const item = document.createElement('li')
      const link = document.createElement('a')
      link.href = entry.address
      link.textContent = entry.title
      const place = document.createElement('span')
      place.className = 'where'
      place.textContent = entry.place
      item.append(link, ' ', place, excerpt(entry, query, words))
      list.append(item)
    }
    const total = (whole.length ? whole : found).length
    status.textContent = total === 0 ? 'Nothing found.'
      : total === 1 ? 'One place.' : total > MOST ? `${total} places, the best ${MOST}:` : `${total} places:`
  }

  field.value = new URLSearchParams(location.search).get('q') || ''
  field.addEventListener('input', show)
  form.addEventListener('submit', event => {
    event.preventDefault()
    show()
    const first = list.querySelector('a')
    if (first) first.focus()
  })
  show()
  if (!field.value) field.focus()
})()
