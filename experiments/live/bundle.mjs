// The page and the package from their sources and the built module.
// usage: node bundle.mjs BUILD PAGE PACKAGE SOURCE   SOURCE: where links to documents go, such as ..
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { gzipSync } from 'node:zlib'

const [build, page, folder, source] = process.argv.slice(2)
const here = dirname(new URL(import.meta.url).pathname)
const read = name => readFileSync(join(here, name), 'utf8')
const glue = readFileSync(join(build, 'cutbench_live.js'), 'utf8'), wasm = readFileSync(join(build, 'cutbench_live.wasm'))

/** Four bytes as five characters that a string in a script can hold; base 64 would be a twentieth larger. */
function inBase85(bytes) {
  const digits = [...Array(92).keys()].map(i => String.fromCharCode(35 + i)).filter(c => !"'<\\".includes(c))
  const padded = Buffer.concat([bytes, Buffer.alloc(3)]), text = []
  for (let i = 0; i < bytes.length; i += 4) {
    const four = []
    for (let v = padded.readUInt32BE(i), k = 0; k < 5; ++k, v = Math.floor(v / 85)) four.unshift(digits[v % 85])
    text.push(four.join(''))
  }
  return text.join('')
}

// Lines of comments and indentation are left out: a smaller file, still readable.
const bare = text => text.replace(/^\s*\/\*\*[^]*?\*\/\s*$/gm, '').split('\n').filter(line => !/^\s*\/\//.test(line)).map(line => line.trim()).filter(Boolean).join('\n')
const api = bare(read('package/cutbench.mjs').replace(/^import .*$/m, '').replace(/^export /gm, ''))
const worker = glue + '\n' + api + '\n' + bare(read('page/worker.js'))
const packed = gzipSync(wasm, { level: 9 })
const script = text => text.replace(/<\/script/g, '<\\/script')
const scripts = [
  `<script id="worker" type="text/plain">${script(worker)}</script>`,
  `<script>const workerAddress = URL.createObjectURL(new Blob([document.getElementById('worker').textContent], { type: 'text/javascript' }))`,
  `const wasmText = '${inBase85(packed)}', wasmSize = ${packed.length}</script>`,
  `<script>${script(['case', 'hands', 'view', 'page'].map(name => bare(read(`page/${name}.js`))).join('\n'))}</script>`
]
const html = read('page/index.html').replace('<!--style-->', () => `<style>${read('page/style.css')}</style>`).replace('<!--scripts-->', () => scripts.join('\n'))
writeFileSync(page, html.replaceAll('@source@', source))

mkdirSync(folder, { recursive: true })
for (const name of ['cutbench.mjs', 'cutbench.d.ts', 'package.json', 'README.md']) copyFileSync(join(here, 'package', name), join(folder, name))
copyFileSync(join(here, '../../LICENSE'), join(folder, 'LICENSE'))
writeFileSync(join(folder, 'engine.mjs'), glue + '\nexport default Engine\n')
writeFileSync(join(folder, 'cutbench.wasm'), wasm)
