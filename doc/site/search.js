// Search in the sections of all pages, from search_index.js: entries of address, title, place, prose, code, group,
// language and the names that the section declares or explains. Only whole words and their beginnings count.
(function () {
  'use strict'
  const form = document.querySelector('header form')
  const field = form.querySelector('input')
  const choices = document.getElementById('languages')
  const status = document.getElementById('status')
  const results = document.getElementById('results')
  // Hits of a group that are shown at once, and those that can be opened.
  const FIRST = 6
  const MOST = 40
  const REMEMBERED = 'fuge language'
  // In the order in which they are shown: those before the references are read first.
  const GROUPS = ['Tutorials and how-to', 'Python', 'C', 'Fortran', 'FORTRAN 77', 'Files and the command',
    'Theory and performance', 'Examples and the project']
  const REFERENCES = ['Python', 'C', 'Fortran', 'FORTRAN 77']
  const EXACT = 'exact'
  const STOP_WORDS = new Set(('a an and any are as at be by can could do does for from get has have how i if in into ' +
    'is it its me my need of on or should so than that the their then there this to use using want was what when ' +
    'where which who why will with would you your').split(' '))
  // A stem has to have this many letters.
  const STEM = 4

  // Letters without case and accents; a hyphen is a space, so that half-width is found as half width.
  function plain (text) {
    return text.toLowerCase().normalize('NFD').replace(/[\u0300-\u036f]/g, '').replace(/[-\u2010-\u2015]/g, ' ')
  }

  // An excerpt is of prose where that has the word.
  const entries = sections.map(([address, title, place, prose, code, group, language, names]) => {
    const text = (prose + ' ' + code).trim()
    return {
      address, title, place, text, group, language, names, plainText: plain(text), plainProse: plain(prose),
      plainTitle: plain(title).replace(/^(?:the|an?) /, '')
    }
  })

  // A word without its ending: tilting, tilts and tilted as tilt.
  function stem (word) {
    const short = word.replace(/(?:ings?|ed|es|s)$/, '')
    return /^[a-z]+$/.test(word) && short.length >= STEM && !word.endsWith('ss') ? short : word
  }

  // What finds the words that begin with a word: parts of names count as words.
  function beginning (word) {
    const escaped = word.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')
    return new RegExp('(?<![a-z0-9])' + escaped + '([a-z0-9]*)', 'g')
  }

  // The number of times that a word is there: one that is longer counts less.
  function count (text, word) {
    let found = 0
    for (const [, rest] of text.matchAll(word.pattern)) found += word.endings.includes(rest) ? 1 : 0.3
    return Math.min(found, 20)
  }

  function wordsOf (query) {
    const all = [...new Set(query.split(' '))].filter(word => /[a-z0-9]/.test(word))
    const wanted = all.filter(word => !STOP_WORDS.has(word))
    return (wanted.length ? wanted : all).map(word =>
      ({ pattern: beginning(stem(word)), endings: ['', word.slice(stem(word).length), 's'] }))
  }

  // How well an entry answers a query: titles before text; all words have to be there, unless no entry has them all.
  function score (entry, query, words) {
    let sum = 0
    let hits = 0
    for (const word of words) {
      const inText = (count(entry.plainText, word) + 2 * count(entry.plainProse, word)) / 3
      const inTitle = count(entry.plainTitle, word)
      if (inText || inTitle) hits++
      sum += Math.log2(1 + inText) * rare(entry) + 12 * Math.min(inTitle, 1) / words.length
    }
    if (hits < words.length) return sum * 0.01 * hits / words.length
    if (words.length > 1) sum += 16 * Math.log2(1 + phrases(entry, query)) * rare(entry)
    if (entry.plainTitle.startsWith(query)) sum += 10
    return entry.place.includes('Changelog') || entry.address.includes('file_') ? 0.5 * sum : sum
  }

  function phrases (entry, query) {
    const phrase = { pattern: beginning(query), endings: [''] }
    const name = { pattern: beginning(query.replace(/ /g, '_')), endings: [''] }
    return count(entry.plainText, phrase) + count(entry.plainText, name)
  }

  // Is the query the name of what the entry is about?
  function isAbout (entry, query) {
    if (entry.names.includes(query)) return true
    if (isName(query)) return entry.plainTitle.split(/[\s,(]+/).includes(query)
    const explains = entry.group === GROUPS[0] || entry.group === 'FORTRAN 77' || entry.place.startsWith('Theory')
    return explains && entry.plainTitle === query
  }

  function isName (query) {
    return query.includes('_') || /^fuge\w/.test(query)
  }

  // A word in a short section says more about it than one in a long one.
  function rare (entry) {
    return 1 / Math.sqrt(1 + entry.plainText.length / 4000)
  }

  // The part of the text around the first word that is found, with all words marked.
  function excerpt (entry, query, words) {
    let at = entry.plainText.search(beginning(query))
    for (const word of words) if (at < 0) at = entry.plainText.search(word.pattern)
    const start = at < 100 ? 0 : entry.text.indexOf(' ', at - 90) + 1
    const part = entry.text.slice(start, start + 260)
    const shown = document.createElement('p')
    if (start) shown.append('… ')
    let rest = 0
    const low = plain(part)
    // Letters that have no single one without accent would shift the marks.
    const found = low.length !== part.length ? [] : words.flatMap(word =>
      [...low.matchAll(word.pattern)].map(match => [match.index, match[0].length])).sort((a, b) => a[0] - b[0])
    for (const [place, length] of found) {
      if (place < rest) continue
      shown.append(part.slice(rest, place))
      const mark = document.createElement('mark')
      mark.textContent = part.slice(place, place + length)
      shown.append(mark)
      rest = place + length
    }
    shown.append(part.slice(rest), start + 260 < entry.text.length ? ' …' : '')
    return shown
  }

  function itemOf (entry, query, words) {
    const item = document.createElement('li')
    const link = document.createElement('a')
    link.href = entry.address
    link.textContent = entry.title
    const place = document.createElement('span')
    place.className = 'where'
    place.textContent = entry.place
    item.append(link, ' ', place, excerpt(entry, query, words))
    return item
  }

  function listOf (found, query, words) {
    const list = document.createElement('ol')
    list.append(...found.map(entry => itemOf(entry, query, words)))
    return list
  }

  // A group: its heading, the first hits, and the others to be opened.
  function sectionOf (group, found, query, words) {
    const section = document.createElement('section')
    section.dataset.group = group
    if (group !== EXACT) {
      const heading = document.createElement('h2')
      heading.textContent = group
      section.append(heading)
    }
    section.append(listOf(found.slice(0, FIRST), query, words))
    const others = found.slice(FIRST, MOST)
    if (others.length) {
      const more = document.createElement('details')
      const summary = document.createElement('summary')
      summary.textContent = `${others.length} more`
      more.append(summary)
      more.addEventListener('toggle', () => {
        if (more.open && !more.querySelector('ol')) more.append(listOf(others, query, words))
      })
      section.append(more)
    }
    return section
  }

  // The hits, best first, by groups: what the query names, then the groups in their order; for a name the references
  // before the tutorials.
  function groupsOf (best, query) {
    const exact = best.filter(entry => isAbout(entry, query))
    const order = isName(query) ? [...REFERENCES, ...GROUPS.filter(group => !REFERENCES.includes(group))] : GROUPS
    return [[EXACT, exact], ...order.map(group =>
      [group, best.filter(entry => entry.group === group && !exact.includes(entry))])]
      .filter(([, found]) => found.length)
  }

  function chosenLanguage () {
    const chosen = choices.querySelector('input:checked')
    return chosen ? chosen.value : ''
  }

  function show () {
    const query = plain(field.value).trim().replace(/\s+/g, ' ')
    const words = wordsOf(query)
    const language = chosenLanguage()
    results.replaceChildren()
    status.textContent = ''
    if (!words.length) return
    const scored = entries.filter(entry => !language || !entry.language || entry.language === language)
      .map(entry => [score(entry, query, words), entry]).filter(([points]) => points > 0).sort((a, b) => b[0] - a[0])
    // Those with all words, if there are any.
    const whole = scored.filter(([points]) => points >= 0.5)
    const best = (whole.length ? whole : scored).map(([, entry]) => entry)
    for (const [group, found] of groupsOf(best, query)) results.append(sectionOf(group, found, query, words))
    status.textContent = best.length === 0 ? 'Nothing found.'
      : best.length === 1 ? 'One place.' : `${best.length} places:`
  }

  // A file may be opened where nothing can be remembered.
  function remember (language) {
    try { localStorage.setItem(REMEMBERED, language) } catch { /* asked anew the next time */ }
  }

  function remembered () {
    try { return localStorage.getItem(REMEMBERED) } catch { return null }
  }

  const asked = new URLSearchParams(location.search)
  const before = asked.get('language') ?? remembered()
  for (const choice of choices.querySelectorAll('input')) {
    choice.checked = choice.value === (before ?? '')
    choice.addEventListener('change', () => {
      remember(choice.value)
      show()
    })
  }
  field.value = asked.get('q') || ''
  field.addEventListener('input', show)
  form.addEventListener('submit', event => {
    event.preventDefault()
    show()
    const first = results.querySelector('a')
    if (first) first.focus()
  })
  show()
  if (!field.value) field.focus()
})()
