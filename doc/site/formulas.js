// Formulas as HTML: node formulas.js KATEX reads [[display, formula], ..] as JSON and writes their HTML, in the
// same order. A formula that KaTeX cannot read ends the program with a message.
const fs = require('fs')
const katex = require(process.argv[2])

const options = { strict: 'error', throwOnError: true, macros: { '\\T': '\\mathsf{T}' } }
const shown = JSON.parse(fs.readFileSync(0, 'utf8')).map(([display, formula]) => {
  try {
    // The TeX source in the MathML is of no use to readers, and would be found by searches for text.
    return katex.renderToString(formula, { ...options, displayMode: display })
      .replace(/<annotation encoding="application\/x-tex">.*?<\/annotation>/s, '')
  } catch (error) {
    console.error(`fuge: in the formula ${formula}\n      ${error.message}`)
    process.exit(1)
  }
})
process.stdout.write(JSON.stringify(shown))
