// The page in headless Chromium: strokes, clicks, touch, keys, four methods, the address, files and their native replay.
// usage: node tests/live/browser.mjs PAGE PROGRAM FOLDER [TEST...]   PROGRAM: cutbench of a portable build; FOLDER: has
//   node_modules/playwright-core, and gets downloads and screenshots. Exit code 1 and a line for each fault.
import { execFileSync } from 'node:child_process'
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { createRequire } from 'node:module'
import { tmpdir } from 'node:os'
import { join, resolve } from 'node:path'

const [page, program, folder, ...wanted] = process.argv.slice(2)
const { chromium } = createRequire(resolve(folder) + '/')('playwright-core')
const address = 'file://' + resolve(page), shots = join(folder, 'shots')
mkdirSync(shots, { recursive: true })
let faults = 0, where = ''
const expect = (what, condition) => {
  if (!condition) console.log(`${where}: ${what}`), faults++
}

const desktop = { viewport: { width: 1280, height: 900 } }
const phone = { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true }

/** Opens the page, paused from the start (reduced motion), so that run() alone moves it. */
async function visit(hash, options, use, before) {
  const profile = mkdtempSync(join(tmpdir(), 'live-'))
  const browser = await chromium.launchPersistentContext(profile, {
    executablePath: '/usr/bin/chromium', headless: true, acceptDownloads: true, reducedMotion: 'reduce', ...options,
    args: ['--no-sandbox', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']
  })
  const tab = await browser.newPage()
  tab.on('pageerror', error => expect(error.message, false))
  tab.on('request', request => expect(`asked for ${request.url().slice(0, 80)}`, /^(file|blob|data):/.test(request.url())))
  try {
    if (before) await before(tab)
    await tab.goto(address + (hash || ''))
    await use(tab)
  } finally {
    await browser.close()
    rmSync(profile, { recursive: true, force: true })
  }
}
const ready = tab => tab.waitForFunction(() => window.live && live.frames.ready && !live.time.halted && !live.time.busy, null, { timeout: 60000 })
const run = (tab, steps) => tab.evaluate(n => live.run(n), steps)
const judged = tab => tab.waitForFunction(() => live.panels.every(p => p.numbers.oracle && p.numbers.ms), null, { timeout: 120000 })
const strokes = tab => tab.evaluate(() => live.state.strokes)
const numbers = tab => tab.evaluate(() => live.panels.map(p => p.numbers))
const cut = async (tab, count) => {
  await tab.waitForFunction(n => live.state.strokes.filter(s => s.done).length === n && !live.time.busy, count, { timeout: 30000 })
}
async function screen(tab, index = 0) {
  const r = await tab.locator('canvas.over').nth(index).boundingBox()
  return (x, y) => [r.x + x * r.width, r.y + y * r.height]
}
/** Where places of the hanging sheet at rest are in the window. */
const seen = (tab, points, index = 0) => tab.evaluate(([points, index]) => {
  const { view } = live.panels[index], r = view.canvas.getBoundingClientRect()
  return points.map(p => view.project(p)).map(([x, y]) => [r.left + x / view.ratio, r.top + y / view.ratio])
}, [points, index])
/** Whether what is up in the picture is up in the cut at rest. */
const upright = tab => tab.evaluate(() => {
  const places = live.panels[0].view.thin(0), mean = of => places.reduce((sum, p) => sum + of(p), 0) / places.length
  const seen = mean(p => p.seen[1]), flat = mean(p => p.flat[1])
  return mean(p => (p.seen[1] - seen) * (p.flat[1] - flat)) < 0  // on the canvas y points down
})
async function drag(tab, from, to, steps = 12) {
  await tab.mouse.move(...from)
  await tab.mouse.down()
  for (let i = 1; i <= steps; ++i) await tab.mouse.move(from[0] + ((to[0] - from[0]) * i) / steps, from[1] + ((to[1] - from[1]) * i) / steps)
  await tab.mouse.up()
}
/** Rest places and triangles of an OBJ, which are the cut. */
const restOf = obj => JSON.stringify(obj.split('\n').filter(l => /^(vt|f) /.test(l)).map(l => l.startsWith('f') ? l : l.split(' ').slice(1).map(Number)))

const tests = {
  async stroke() {
    await visit('', desktop, async tab => {
      await ready(tab)
      await run(tab, 100)
      const [a, b] = await seen(tab, [[0.2, 0.4], [0.7, 0.45]])
      await drag(tab, a, b)
      await cut(tab, 1)
      await judged(tab)
      const [n] = await numbers(tab), [stroke] = await strokes(tab)
      expect(`cut by warp_and_refine: ${JSON.stringify(n)}`, n.status === 'ok' && n.added > 0 && n.oracle.verdict === 'ok' && n.eigenvalue_ratio > 0.5)
      expect(`the stroke is Beziers, at step 100: ${JSON.stringify(stroke)}`, stroke.step === 100 && stroke.curve.bezier.length % 3 === 1)
      expect('it begins where the mouse went down', Math.hypot(stroke.curve.bezier[0][0] - 0.2, stroke.curve.bezier[0][1] - 0.4) < 0.01)
      expect('the cut at rest is upside down', await upright(tab))
      expect('the cut is announced', /oracle says warp_and_refine: right/.test(await tab.textContent('#announce')))
      expect('the table says right', /right/.test(await tab.textContent('#numbers tbody')))
      const [p, outside] = await seen(tab, [[0.5, 0.7], [0.999, 0.7]])
      await drag(tab, p, [outside[0] + 40, outside[1]])
      await cut(tab, 2)
      const last = (await strokes(tab))[1].curve.bezier.at(-1)
      expect(`a stroke that ends beside the sheet crosses its border: ${last}`, last[0] > 1)
      await run(tab, 60)
      await tab.screenshot({ path: join(shots, 'stroke.png') })
      await tab.click('#undo')
      await cut(tab, 1)
      expect('undo takes the last stroke back', (await tab.evaluate(() => live.time.step)) === 100)
      await drag(tab, (await screen(tab))(0.02, 0.9), (await screen(tab))(0.1, 0.95))
      expect('a miss is said', /misses/.test(await tab.textContent('#hint')))
    })
  },
  async clicks() {
    await visit('', desktop, async tab => {
      await ready(tab)
      await run(tab, 60)
      for (const [i, place] of (await seen(tab, [[0.2, 0.3], [0.4, 0.5], [0.6, 0.2], [0.8, 0.4]])).entries()) {
        await tab.mouse.click(...place)
        if (i === 2) {
          expect('three points wait', /Point 3 of 4/.test(await tab.textContent('#hint')))
          await tab.waitForTimeout(200)
          await tab.screenshot({ path: join(shots, 'clicks.png') })
        }
      }
      await cut(tab, 1)
      const [{ curve }] = await strokes(tab)
      expect(`four clicks are one Bezier: ${JSON.stringify(curve)}`, curve.bezier.length === 4 && Math.hypot(curve.bezier[3][0] - 0.8, curve.bezier[3][1] - 0.4) < 0.01)
    })
  },
  async touch() {
    await visit('', phone, async tab => {
      await ready(tab)
      await run(tab, 60)
      for (const place of await seen(tab, [[0.2, 0.3], [0.4, 0.5], [0.6, 0.2], [0.8, 0.4]])) await tab.touchscreen.tap(...place)
      await cut(tab, 1)
      expect('four taps cut', (await numbers(tab))[0].status === 'ok')
      const before = await tab.evaluate(() => live.camera.around)
      const at = await screen(tab), fingers = await tab.context().newCDPSession(tab)
      const send = (type, points) => fingers.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) })
      await send('touchStart', [at(0.4, 0.5)])
      await send('touchStart', [at(0.4, 0.5), at(0.6, 0.5)])
      for (let i = 1; i < 8; ++i) await send('touchMove', [at(0.4 + 0.02 * i, 0.5), at(0.6 + 0.03 * i, 0.5)])
      await send('touchEnd', [])
      expect('two fingers turn', (await tab.evaluate(() => live.camera.around)) !== before)
      expect('two fingers draw nothing', (await strokes(tab)).length === 1)
      const wide = await tab.evaluate(() => document.documentElement.scrollWidth)
      expect(`a phone needs no sideways scrolling: ${wide}`, wide <= 390)
      const small = await tab.evaluate(() => [...document.querySelectorAll('button, select, summary, input[type=file]')].filter(e => e.offsetParent && Math.round(e.getBoundingClientRect().height) < 44).map(e => e.id || e.textContent))
      expect(`targets of 44 px: ${small}`, !small.length)
      await tab.screenshot({ path: join(shots, 'phone.png') })
    })
  },
  async four() {
    await visit('#vertex', { ...desktop, colorScheme: 'dark' }, async tab => {
      await ready(tab)
      await run(tab, 200)
      await judged(tab)
      const all = await numbers(tab)
      expect('four sheets', all.length === 4)
      expect(`all cut, all right: ${all.map(n => n.status + ' ' + n.oracle.verdict)}`, all.every(n => n.status === 'ok' && n.oracle.verdict === 'ok'))
      expect('they made the same steps', new Set(all.map(n => n.time)).size === 1)
      expect('a plain split leaves slivers, warping does not', all[0].aspect_ratio > 100 && all[3].aspect_ratio < 10)
      await tab.waitForTimeout(300)
      await tab.screenshot({ path: join(shots, 'four.png') })
      await tab.selectOption('#count', '2')
      await ready(tab)
      await tab.selectOption('#methods select >> nth=1', 'bowyer_watson')
      await ready(tab)
      await run(tab, 130)
      expect('two sheets of other methods are cut by the same stroke', (await numbers(tab)).length === 2 && (await numbers(tab)).every(n => n.status === 'ok'))
    })
  },
  async another() {  // what a newcomer does: a stroke, the button, and which method made worse triangles is said
    await visit('#n=800&h=corners', phone, async tab => {
      await ready(tab)
      expect('nothing to make again yet', await tab.locator('#another').isHidden())
      await run(tab, 600)
      for (const place of await seen(tab, [[0.2, 0.31], [0.4, 0.5], [0.6, 0.2], [0.8, 0.43]])) await tab.touchscreen.tap(...place)
      await cut(tab, 1)
      expect('the thinnest triangle is said', /thinnest triangle is [\d.]+ times/.test(await tab.textContent('#hint')))
      const button = await tab.locator('#another').boundingBox()
      expect(`the button is in sight on a phone: ${JSON.stringify(button)}`, button.y + button.height <= 780)
      await tab.screenshot({ path: join(shots, 'another_phone.png') })
      await tab.tap('#another')
      await ready(tab)
      await run(tab, 480 + 60)
      const all = await numbers(tab)
      expect('two methods made the cut, two seconds from the start', all.length === 2 && all.every(n => n.status === 'ok') && (await strokes(tab))[0].step === 480)
      expect('the worse one is said', all[1].aspect_ratio > all[0].aspect_ratio && /^Worst triangles: conventional_split/.test(await tab.textContent('#hint')))
      await tab.waitForTimeout(300)
      await tab.screenshot({ path: join(shots, 'another.png') })
    })
  },
  async presets() {
    const names = ['fig5a', 'fig5b', 'fig6a', 'fig6b', 'fig7a', 'fig7b', 'fig8', 'fig10', 'recut', 'forty']
    await visit('', desktop, async tab => {
      await ready(tab)
      for (const name of names) {
        await tab.selectOption('#preset', name)
        await ready(tab)
        await run(tab, name === 'forty' ? 540 : 240)
        await judged(tab)
        const all = await tab.evaluate(() => live.panels.map(p => [p.method, p.numbers.status, p.numbers.oracle.verdict, p.numbers.pieces, p.stopped]))
        expect(`${name}: ${all.join('; ')}`, all.every(([, status, verdict, , stopped]) => ['ok', 'deviated'].includes(status) && verdict === 'ok' && !stopped))
        if (name === 'fig6b') expect('a piece falls out', all[0][3] === 2)
        await tab.waitForTimeout(200)
        if (name === 'fig6a') expect('the cut at rest is upside down', await upright(tab))
        await tab.screenshot({ path: join(shots, name + '.png') })
      }
    })
  },
  async address() {
    const obj = tab => tab.evaluate(() => live.panels[0].remote.ask('obj'))
    let link = '', first = ''
    await visit('', desktop, async tab => {
      await ready(tab)
      await run(tab, 80)
      await drag(tab, ...(await seen(tab, [[0.3, 0.3], [0.6, 0.6]])))
      await cut(tab, 1)
      await run(tab, 60)
      link = await tab.evaluate(() => location.hash)
      first = await obj(tab)
    })
    await visit(link, desktop, async tab => {
      await ready(tab)
      await run(tab, 140)
      expect('the address gives the same sheet, bit for bit, in motion', (await obj(tab)) === first)
    })
    await visit('#n=800&h=corners&k=conventional_split', desktop, async tab => {
      await ready(tab)
      await run(tab, 60)
      await tab.click('[data-tool=pull]')
      const [[x, y]] = await seen(tab, [[0.5, 0.8]])
      await tab.mouse.move(x, y)
      await tab.mouse.down()
      for (let i = 1; i < 6; ++i) {
        await tab.mouse.move(x + 20 * i, y - 10 * i)
        await run(tab, 8)
      }
      await tab.mouse.up()
      await tab.click('[data-tool=poke]')
      await run(tab, 20)
      await tab.mouse.click(...(await seen(tab, [[0.4, 0.5]]))[0])
      await run(tab, 10)
      await tab.click('[data-tool=cut]')
      await drag(tab, ...(await seen(tab, [[0.3, 0.3], [0.6, 0.6]])))
      await cut(tab, 1)
      await run(tab, 40)
      link = await tab.evaluate(() => location.hash)
      expect(`the address holds a pull and a poke: ${link}`, /&u=60g0,[^;]*;120k0,[^;]*$/.test(link))
      first = await obj(tab)
      const toml = await tab.evaluate(() => tomlOf(live.state))
      expect('the scene file says what it leaves out', /2 pulls and pokes are left out/.test(toml))
    })
    await visit(link, desktop, async tab => {
      await ready(tab)
      await run(tab, 170)
      expect('with what hands did the motion is the same, too, bit for bit', (await obj(tab)) === first)
      await tab.click('#undo')
      await cut(tab, 0)
      await run(tab, 40)
      expect('undo leaves the hands before the stroke', (await tab.evaluate(() => live.state.hands.length)) > 3)
      await tab.click('#undo')
      await ready(tab)
      expect('and then takes them back, too', (await tab.evaluate(() => live.state.hands.length + live.time.step)) === 0)
    })
    await visit('#n=99&c=5b1,2;x;9p.1,.5,.9,.5&k=nonsense&g=-4&u=3g0,.5;7k0,.5,.5,1,1;9k0,.5,.5,0,1,0;x', desktop, async tab => {
      await ready(tab)
      expect('what an address says wrongly is left out', (await strokes(tab)).length === 1 && (await tab.evaluate(() => live.state.gravity)) === 1 && (await tab.evaluate(() => live.state.hands.length)) === 1)
    })
  },
  async files() {
    for (const [hash, method] of [['#fig7b', 'warp_and_refine'], ['#fig6b', 'bowyer_watson'], ['#n=800&f=delaunay&h=corners&k=cut_polygons&c=40b.2,.3,.4,.5,.6,.2,.8,.4', 'cut_polygons']])
      await visit(hash, desktop, async tab => {
        await ready(tab)
        await tab.selectOption('#methods select', method)
        await ready(tab)
        await run(tab, Math.max(...(await strokes(tab)).map(s => s.step)) + 240)
        const place = join(folder, 'case')
        mkdirSync(place, { recursive: true })
        await tab.click('#files summary')
        for (const name of ['sheet.obj', 'path.json', 'scene.toml', 'cut.obj']) {
          const [file] = await Promise.all([tab.waitForEvent('download'), tab.click(`[data-file="${name}"]`)])
          expect('it has its name', file.suggestedFilename() === name)
          await file.saveAs(join(place, name))
        }
        const text = name => readFileSync(join(place, name), 'utf8')
        execFileSync(program, ['simulate', join(place, 'scene.toml'), '--method', method, '--out', join(place, 'native.obj')], { stdio: 'pipe' })
        expect(`${method}: the native program makes the same cuts, bit for bit`, restOf(text('native.obj')) === restOf(text('cut.obj')))
        const places = obj => obj.split('\n').filter(l => l.startsWith('v ')).map(l => l.split(' ').slice(1).map(Number))
        const [here, there] = [places(text('cut.obj')), places(text('native.obj'))]
        let apart = 0
        if (here.length === there.length) here.forEach((p, i) => p.forEach((v, k) => (apart = Math.max(apart, Math.abs(v - there[i][k])))))
        expect(`${method}: after the replay by a portable build vertices are ${apart} m apart`, apart === 0)
        execFileSync(program, ['cut', '--mesh', join(place, 'sheet.obj'), '--path', join(place, 'path.json'), '--method', method, '--out', join(place, 'flat.obj')], { stdio: 'pipe' })
      })
  },
  async obj() {
    let link = '', first = ''
    await visit('', desktop, async tab => {
      await ready(tab)
      const n = 12, lines = []
      for (let j = 0; j <= n; ++j) for (let i = 0; i <= n; ++i) lines.push(`v ${(2 * i) / n} ${(1.5 * j) / n} 0`)
      for (let j = 0; j < n; ++j) for (let i = 0; i < n; ++i) { const c = j * (n + 1) + i + 1; lines.push(`f ${c} ${c + 1} ${c + n + 2}`, `f ${c} ${c + n + 2} ${c + n + 1}`) }
      const text = lines.join('\n') + '\n'
      await tab.evaluate(text => {
        const data = new DataTransfer()
        data.items.add(new File([text], 'mine.obj'))
        document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }))
      }, text)
      await tab.waitForFunction(() => live.state.obj && !live.time.halted && live.panels[0].numbers.triangles === 288, null, { timeout: 20000 })
      await run(tab, 60)
      await drag(tab, ...(await seen(tab, [[0.5, 0.4], [1.4, 0.8]])))
      await cut(tab, 1)
      await judged(tab)
      expect('a sheet of ones own is cut, rightly', (await numbers(tab))[0].oracle.verdict === 'ok')
      await tab.screenshot({ path: join(shots, 'obj.png') })
      await run(tab, 20)
      link = await tab.evaluate(() => location.hash)
      expect(`the link holds the sheet: ${link}`, /[#&]o=[-\w]{100,}&/.test(link))
      first = await tab.evaluate(() => live.panels[0].remote.ask('obj'))
      writeFileSync(join(folder, 'bad.obj'), 'v 0 0 0\nv 1 0 0\nf 1 2 3\n')
      await tab.setInputFiles('#obj', join(folder, 'bad.obj'))
      await tab.waitForFunction(() => /bad.obj/.test(document.getElementById('hint').textContent), null, { timeout: 20000 })
      expect('a bad one leaves the sheet as it was', (await numbers(tab))[0].triangles > 288)
      const noise = Array.from({ length: 4000 }, () => `v ${Math.random()} ${Math.random()} 0`).join('\n')
      const large = await tab.evaluate(async noise => {
        const state = { ...live.state, packed: await packed(live.state.obj + noise) }
        return [addressOf(state), (await unpacked(state.packed)) === live.state.obj + noise]
      }, noise)
      expect('a large sheet makes no link', large[0] === null && large[1])
    })
    await visit(link, desktop, async tab => {
      await ready(tab)
      await run(tab, 80)
      expect('the link gives the same sheet, bit for bit', (await tab.evaluate(() => live.panels[0].remote.ask('obj'))) === first)
    })
    await visit('#o=nonsense&k=conventional_split', desktop, async tab => {
      await ready(tab)
      expect('a link whose sheet is broken says so', /can't be read/.test(await tab.textContent('#hint')))
    })
  },
  async failing() {
    await visit('#fig8', desktop, async tab => {
      await ready(tab)
      await tab.evaluate(() => live.panels[0].remote.ask('nothing').catch(() => {}))
      await tab.waitForSelector('.stopped')
      await run(tab, 140)
      expect('the other sheet goes on', (await numbers(tab))[1].status === 'ok')
      await tab.click('.stopped button')
      await ready(tab)
      await run(tab, 140)
      expect('it starts again', (await numbers(tab)).every(n => n.status === 'ok') && !(await tab.$('.stopped')))
    })
    const without = name => tab => tab.addInitScript(name => { delete window[name] }, name)
    await visit('', desktop, async tab => {
      await tab.waitForSelector('#lack:not([hidden])')
      expect('what the browser lacks is said', /lacks DecompressionStream/.test(await tab.textContent('#lack')))
    }, without('DecompressionStream'))
  },
  async keyboard() {
    await visit('', desktop, async tab => {
      await ready(tab)
      await run(tab, 240)
      for (let i = 0; i < 30 && !(await tab.evaluate(() => document.activeElement.className === 'over')); ++i) await tab.keyboard.press('Tab')
      const press = async (key, times) => { for (let i = 0; i < times; ++i) await tab.keyboard.press(key) }
      await press('ArrowLeft', 10)
      for (let i = 0; i < 4; ++i) {
        await press('Enter', 1)
        await press('ArrowRight', 6)
        await press(i % 2 ? 'ArrowUp' : 'ArrowDown', 2)
      }
      await cut(tab, 1)
      expect(`keys alone cut: ${JSON.stringify(await strokes(tab))}`, (await numbers(tab))[0].status === 'ok')
      await tab.waitForTimeout(300)
      await tab.screenshot({ path: join(shots, 'keyboard.png') })
      const was = await tab.evaluate(() => live.camera.around)
      await press('Shift+ArrowLeft', 2)
      expect('Shift and arrows turn', (await tab.evaluate(() => live.camera.around)) !== was)
      await press('u', 1)
      await cut(tab, 0)
      await press(' ', 1)
      await tab.waitForFunction(() => live.time.step > 245, null, { timeout: 20000 })
      await press(' ', 1)
      expect('the space bar plays and pauses', await tab.evaluate(() => live.time.paused))
    })
  },
  async pull() {
    await visit('#n=800&h=corners', desktop, async tab => {
      await ready(tab)
      await run(tab, 240)
      const place = () => tab.evaluate(() => live.panels[0].view.place([0.5, 0.8]))
      await tab.click('[data-tool=pull]')
      const [[x, y]] = await seen(tab, [[0.5, 0.8]]), before = await place()
      await tab.mouse.move(x, y)
      await tab.mouse.down()
      await tab.mouse.move(x + 120, y - 80, { steps: 4 })
      await run(tab, 60)
      const pulled = await place()
      await tab.mouse.up()
      expect(`it follows the hand: ${before} ${pulled}`, pulled[0] > before[0] + 0.05 && pulled[2] > before[2] + 0.02)
      await tab.click('[data-tool=poke]')
      await run(tab, 480)
      const calm = await place()
      await tab.mouse.click(...(await seen(tab, [[0.5, 0.8]]))[0])
      await run(tab, 20)
      expect('a poke moves it away', (await place())[1] > calm[1] + 0.03)
    })
  },
  async error() {
    await visit('#n=800&h=sides&k=conventional_split,edge_release&c=60b.25,.3,.9,.2,.9,.8,.25,.7', desktop, async tab => {
      await ready(tab)
      await run(tab, 120)
      await tab.click('#compare')
      await tab.waitForFunction(() => live.panels.every(p => p.numbers.error), null, { timeout: 120000 })
      const [exact, stairs] = (await numbers(tab)).map(n => parseFloat(n.error))
      console.log(`${where}: conventional_split ${exact} mm, edge_release ${stairs} mm`)
      expect('a staircase is farther off than an exact split', exact > 0 && stairs > exact)
      await tab.screenshot({ path: join(shots, 'error.png'), fullPage: true })
    })
  },
  async storm() {
    await visit('', desktop, async tab => {
      await ready(tab)
      for (const [method, strokes] of [['cut_polygons', 10000], ['conventional_split', 500], ['warp_and_refine', 500], ['adaptive_remesh', 500]]) {
        const { failed, first, last } = await tab.evaluate(async ([method, strokes]) => {
          const remote = new live.Remote()
          await remote.ready
          const answer = await remote.ask('storm', { strokes, method, seed: 12345 })
          remote.worker.terminate()
          return answer
        }, [method, strokes])
        console.log(`${where}: ${method}: ${JSON.stringify(failed)}, memory ${first} to ${last} bytes`)
        expect(`${method}: no stroke is lost`, Object.entries(failed).reduce((sum, [key, n]) => sum + (key === 'steps' ? 0 : n), 0) === strokes)
        expect(`${method}: memory does not grow`, strokes < 10000 || last <= first * 1.3)  // but for one larger sheet
      }
    })
  },
  async live() {  // not paused: the clock of a visitor
    await visit('', { ...desktop, reducedMotion: 'no-preference' }, async tab => {
      await ready(tab)
      const first = await tab.evaluate(() => live.frames.ready)
      console.log(`${where}: first picture after ${Math.round(first)} ms`)
      expect(`first picture within 3 s: ${first}`, first < 3000)
      await tab.waitForFunction(() => live.time.step > 100, null, { timeout: 60000 })
      for (const drawn of [true, false]) {  // software draws on the cores that steps need
        const { part, ms, call, rate } = await tab.evaluate(async drawn => {
          if (!drawn) document.getElementById('sheets').style.visibility = 'hidden', (live.panels[0].view.draw = () => {})
          await new Promise(done => setTimeout(done, 1000))
          const from = live.time.step, start = performance.now()
          await new Promise(done => setTimeout(done, 6000))
          const part = (live.time.step - from) / 0.24 / (performance.now() - start)
          return { part, ms: live.panels[0].ms, call: live.frames.drawn, rate: live.frames.rate }
        }, drawn)
        console.log(`${where}: 3,200 triangles${drawn ? '' : ', nothing drawn'}: ${part.toFixed(2)} of real time, ${ms.toFixed(2)} ms a step` +
          (drawn ? `, ${call.toFixed(2)} ms to call the drawing, ${rate.toFixed(1)} frames a second by software` : ''))
      }
    })
  }
}

for (const [name, test] of Object.entries(tests)) {
  if (wanted.length && !wanted.includes(name)) continue
  where = name
  await test().catch(error => expect(error.message.split('\n')[0], false))
}
console.log(faults ? `${faults} faults` : 'the page does what it should')
process.exit(faults ? 1 : 0)
