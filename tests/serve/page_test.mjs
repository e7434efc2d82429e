// The page of `sdlc serve` in a browser. usage: node --test page_test.mjs, with SDLC, CHROMIUM and SDLC_NODE_MODULES.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';

const require = createRequire(join(process.env.SDLC_NODE_MODULES, 'page.cjs'));
const puppeteer = require('puppeteer-core');

const folder = mkdtempSync(join(tmpdir(), 'sdlc-serve-'));
const write = (name, text) => writeFileSync(join(folder, name), text);
const kPatience = 600_000;  // ms
let browser;
const programs = new Set();
async function newPage(context) {
  const page = await context.newPage();
  page.setDefaultTimeout(kPatience);
  return page;
}
before(async () => {
  // A busy machine is slow.
  browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM, args: ['--no-sandbox', '--disable-gpu'],
                                     timeout: kPatience, protocolTimeout: kPatience });
});
after(async () => {
  for (const program of programs) program.kill();  // those of tests that failed would keep this process
  await browser.close();
  rmSync(folder, { recursive: true });
});

// A page of `sdlc serve`, and what ends it.
async function serve(name, { width = 1200, height = 900, scheme = 'light', flags = [] } = {}) {
  const program = spawn(process.env.SDLC, ['serve', name, ...flags], { cwd: folder, stdio: ['ignore', 'pipe', 'inherit'] });
  programs.add(program);
  const url = await new Promise((resolve) => program.stdout.once('data', (data) => resolve(String(data).trim())));
  const context = await browser.createBrowserContext();
  const page = await newPage(context);
  const faults = [];
  page.on('pageerror', (error) => faults.push(error.message));
  page.on('console', (message) => { if (message.type() === 'error') faults.push(message.text()); });
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
  await page.goto(url);
  await page.waitForFunction('picture && picture.header.is_finished');
  const end = async () => {
    await context.close();
    program.kill();
    programs.delete(program);
    await new Promise((resolve) => program.once('exit', resolve));
    assert.deepEqual(faults, []);
  };
  return { page, url, end };
}

const text = async (page, id) => (await page.$eval(`#${id}`, (element) => element.innerText)).trimEnd();
const codeAt = (page, x, y) => page.evaluate(
    (px, py) => [...picture.image.getContext('2d').getImageData(px, py, 1, 1).data.slice(0, 3)], x, y);

async function clickPixel(page, x, y) {
  const [sx, sy] = await page.evaluate((px, py) => {
    const box = canvas.getBoundingClientRect();
    return [box.left + view.x + (px + 0.5) * view.scale, box.top + view.y + (py + 0.5) * view.scale];
  }, x, y);
  await page.mouse.click(sx, sy);
  await page.waitForFunction((px, py) => mark.x === px && mark.y === py && !document.getElementById('sphere').hidden,
                             {}, x, y);
}

const plain = (color = 'white') => `scene 1
camera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg, aspect: 2 }
camera side { from: (9, 0, 0), at: (0, 0, 0), fov: 40deg, aspect: 2 }
background { color: ${color} }
render { width: 80, samples: 16, camera: main }

/// How large the ball is.
param size = 1
param turn = 30deg
param tint = #ff0000
param is_there = true
param label = "a"

if is_there {
  sphere ball { center: (0, 0, 0), radius: size, material: unlit(color: tint) }
}
`;

describe('a save', () => {
  test('shows a new picture, also by replacing the file', async () => {
    write('a.scene', plain());
    const { page, end } = await serve('a.scene');
    assert.deepEqual(await codeAt(page, 2, 2), [255, 255, 255]);
    write('a.scene', plain('black'));
    await page.waitForFunction('picture.header.scene === 2 && picture.header.is_finished');
    assert.deepEqual(await codeAt(page, 2, 2), [0, 0, 0]);
    write('new', plain('#00ff00'));
    renameSync(join(folder, 'new'), join(folder, 'a.scene'));
    await page.waitForFunction('picture.header.scene === 3 && picture.header.is_finished');
    assert.deepEqual(await codeAt(page, 2, 2), [0, 255, 0]);
    assert.match(await text(page, 'status'), /16 samples, error .* %.*finished/);

    await page.click('#compare');
    assert.equal(await page.evaluate('isComparing && before.header.scene'), 2);
    await end();
  });

  test('of comments keeps the picture; of lines before the clicked sphere finds it again', async () => {
    write('a.scene', plain());
    const { page, end } = await serve('a.scene');
    await clickPixel(page, 40, 20);
    await page.waitForFunction("document.getElementById('sphere').innerText.includes('a.scene:15:3')");
    write('a.scene', plain().replace('scene 1\n', 'scene 1\n\n// three\n// lines\n'));
    await page.waitForFunction("document.getElementById('sphere').innerText.includes('a.scene:18:3')");
    assert.equal(await page.evaluate('picture.header.scene'), 1);
    assert.equal(await page.evaluate('before'), null);
    await end();
  });

  test('that is broken shows what is wrong, and the old picture', async () => {
    write('a.scene', plain());
    const { page, end } = await serve('a.scene');
    write('a.scene', plain().replace('radius: size', 'radios: size'));
    await page.waitForFunction('scene && !scene.is_correct');
    const findings = await text(page, 'findings');
    assert.match(findings, /E104/);
    assert.match(findings, /radios: size/);
    assert.match(findings, /did you mean `radius`/);
    await page.focus('#findings a');
    await page.select('#channel', 'normal');
    await page.waitForFunction("picture.header.channel === 'normal'");
    await page.evaluate("choose({params: {turn: '1deg'}})");
    await page.waitForFunction("scene.params[1].value === '1deg'");
    assert.equal(await page.evaluate("document.activeElement.closest('#findings') !== null"), true, 'the focus stays');
    await page.select('#channel', 'color');
    const [link] = await page.$$eval('#findings a', (links) => links.map((a) => [a.innerText, a.href]));
    assert.equal(link[0], 'a.scene:15:36');
    assert.equal(link[1], `vscode://file${folder}/a.scene:15:36`);
    assert.match(await text(page, 'status'), /1 error; the picture is of the last correct version/);
    assert.deepEqual(await codeAt(page, 2, 2), [255, 255, 255]);
    await clickPixel(page, 40, 20);
    assert.match(await text(page, 'sphere'), /“ball”, unlit\s+a.scene:15:3/);
    write('a.scene', plain('black'));
    await page.waitForFunction('scene.is_correct && picture.header.is_finished && picture.header.scene === scene.scene');
    assert.equal(await text(page, 'findings'), '');
    await end();
  });

  test('of an imported file counts', async () => {
    write('colors.scene', 'scene 1\nlet sky = white\n');
    write('b.scene', plain('colors.sky').replace('scene 1', 'scene 1\nimport "colors.scene" as colors'));
    const { page, end } = await serve('b.scene');
    write('colors.scene', 'scene 1\nlet sky = black\n');
    await page.waitForFunction('picture.header.scene === 2');
    assert.deepEqual(await codeAt(page, 2, 2), [0, 0, 0]);
    await end();
  });
});

test('a click names the sphere, its chain and its line, in ten places', async () => {
  write('parts.scene', `scene 1
def pair(gap = 4) {
  sphere { center: (0, gap / 2, 0), radius: 1, material: unlit(color: red) }
  sphere low { center: (0, -gap / 2, 0), radius: 1 }
}
`);
  write('inner.scene', 'scene 1\ngroup { translate: (8, -2, 0)\n  sphere { center: (0, 0, 0), radius: 1, material: unlit(color: blue) }\n}\n');
  write('places.scene', `scene 1
import "parts.scene" as parts
camera { from: (0, 0, 1000), at: (0, 0, 0), fov: 0.8deg, aspect: 2 }
background { color: black }
render { width: 240, samples: 1 }
sphere plain { center: (-12, 2, 0), radius: 1, material: unlit(color: white) }
for i in range(2) {
  sphere { center: (-8, 2 - 4 * i, 0), radius: 1, material: unlit(color: gray) }
}
parts.pair { translate: (-4, 0, 0), material: unlit(color: green) }
def wrapped() { parts.pair { gap: 4 } }
group outer {
  translate: (0, 0, 0)
  wrapped { material: unlit(color: lime) }
}
group { scale: 2, translate: (4, 2, 0)
  group { rotate: (0deg, 90deg, 0deg)
    sphere deep { center: (0, 0, 0), radius: 0.5, material: unlit(color: tan) }
  }
}
include "inner.scene"
`);
  const { page, end } = await serve('places.scene');
  // 240 pixels are 28 m wide: 1 m is 8.6 pixels.
  const lineOf = (file, part) => readFileSync(join(folder, file), 'utf8').split('\n').findIndex((l) => l.includes(part)) + 1;
  const places = [
    [-12, 2, 'places.scene', 'sphere plain', 0],
    [-8, 2, 'places.scene', 'center: (-8', 1],
    [-8, -2, 'places.scene', 'center: (-8', 1],
    [-4, 2, 'parts.scene', 'gap / 2', 1],
    [-4, -2, 'parts.scene', 'sphere low', 1],
    [0, 2, 'parts.scene', 'gap / 2', 2],
    [0, -2, 'parts.scene', 'sphere low', 2],
    [4, 2, 'places.scene', 'sphere deep', 0],
    [8, -2, 'inner.scene', 'sphere {', 1],
  ];
  for (const [x, y, file, part, links] of places) {
    await clickPixel(page, Math.round(120 + x * 8.59), Math.round(60 - y * 8.59));
    const line = lineOf(file, part);
    await page.waitForFunction((place) => document.getElementById('sphere').innerText.includes(place), {}, `${file}:${line}:`)
        .catch(async () => assert.fail(`${x}, ${y}: ${file}:${line} is not in: ${await text(page, 'sphere')}`));
    assert.ok((await page.$$('#sphere ol li')).length >= links, `${x}, ${y}: ${await text(page, 'sphere')}`);
  }
  await clickPixel(page, 120, 60);
  await page.waitForFunction("document.getElementById('sphere').innerText.includes('background')");
  await end();
});

test('a click in a config names the line of the sphere', async () => {
  const material = '"material": {"type": "diffuse", "color": [255, 0, 0]}';
  write('row.json', `{"camera": {"look_from": [0, 0, 9], "look_at": [0, 0, 0], "up": [0, 1, 0], "vfov": 40,
  "focal_length": 9, "aspect_ratio": 2, "viewport_height": 2, "samples_per_pixel": 1},
 "rendering": {"width": 80, "render_depth": 2}, "saving": {"path": "row.png"},
 "spheres": [
  {"origin": [-3, 0, 0], "radius": 1, ${material}},
  {"origin": [3, 0, 0], "radius": 1, ${material}}
 ]}`);
  const { page, end } = await serve('row.json');
  for (const [x, line] of [[22, 5], [58, 6]]) {
    await clickPixel(page, x, 20);
    await page.waitForFunction((place) => document.getElementById('sphere').innerText.includes(place), {}, `row.json:${line}:`);
  }
  await end();
});

test('a render with an error goal ends within it, also after a change that is taken back', async () => {
  write('a.scene', plain('gray').replace('unlit(color: tint)', 'diffuse(color: tint)').replace('samples: 16', 'samples: 65536'));
  const { page, end } = await serve('a.scene', { flags: ['--error=0.5%'] });
  const ends = async (number) => {
    await page.waitForFunction((n) => picture.header.scene === n && picture.header.is_finished, {}, number);
    const { value, from, to } = await page.evaluate('picture.header.error');
    assert.ok(0 < from && from <= value && value <= to && to <= 0.005, `${value} (${from} to ${to})`);
    assert.match(await text(page, 'status'), /samples, error 0\.\d+ % \(0\.\d+ % to 0\.\d+ %\), finished/);
  };
  await ends(1);
  await page.evaluate("choose({params: {size: '2'}})");
  await page.waitForFunction('scene.scene === 2');
  await page.evaluate("choose({params: {size: 'none'}})");
  await page.waitForFunction('scene.scene === 2 && !scene.is_correct');
  await ends(2);
  await end();
});

test('params are fields with what --set takes, and the command has them', async () => {
  write('a.scene', plain());
  const { page, end } = await serve('a.scene', { flags: ['--samples=4'] });
  assert.equal(await text(page, 'command'), 'sdlc render a.scene --samples=4');
  assert.match(await text(page, 'params'), /How large the ball is\./);
  assert.match(await text(page, 'params'), /--set label=a\n/, 'a string as it is');
  assert.match(await text(page, 'params'), /--set 'tint=#ff0000'/);
  await page.$eval('#param-size', (slider) => {
    slider.value = 2;
    slider.dispatchEvent(new Event('input'));
  });
  await page.waitForFunction("scene.params[0].value === '2'");
  assert.match(await text(page, 'params'), /--set size=2/);
  assert.equal(await text(page, 'command'), 'sdlc render a.scene --samples=4 --set size=2');
  await page.click('#param-is_there');
  await page.waitForFunction("scene.params[3].value === 'false' && picture.header.scene === scene.scene");
  assert.deepEqual(await codeAt(page, 40, 20), [255, 255, 255], 'the ball is gone');
  await page.click('#param-is_there');
  const tint = await page.$('#param-tint');
  await tint.click({ count: 3 });
  await tint.type('#0000ff\n');
  await page.waitForFunction("scene.params[2].value === '#0000ff' && picture.header.scene === scene.scene && picture.header.is_finished");
  assert.deepEqual(await codeAt(page, 40, 20), [0, 0, 255]);
  await tint.click({ count: 3 });
  await tint.type('no colour\n');
  await page.waitForFunction('!scene.is_correct');
  assert.match(await text(page, 'findings'), /tint/);
  await page.click('[aria-label="Reset tint"]');
  await page.waitForFunction('scene.is_correct && scene.params[2].value === null');

  // The value of a param that is renamed is gone.
  write('a.scene', plain().replaceAll('size', 'reach'));
  await page.waitForFunction("scene.is_correct && scene.params[0].name === 'reach'");
  assert.match(await text(page, 'params'), /--set reach=1/);
  await end();
});

test('cameras are chosen, moved and copied back', async () => {
  write('a.scene', plain());
  const { page, end } = await serve('a.scene');
  await page.select('#camera', 'side');
  await page.waitForFunction("scene.shown.camera.name === 'side'");
  assert.match(await text(page, 'command'), /--camera side$/);
  await page.focus('#canvas');
  await page.keyboard.press('o');
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction('scene.has_pose');
  const camera = await page.evaluate('scene.shown.camera');
  assert.ok(Math.abs(Math.hypot(...camera.from) - 9) < 1e-9, 'the distance stays');
  assert.ok(camera.from[2] !== 0);
  assert.equal(await text(page, 'camera-text'),
               `camera side { from: (${camera.from.join(', ')}), at: (0, 0, 0), fov: 40deg, aspect: 2 }`);
  await page.click('#camera-back');
  await page.waitForFunction('!scene.has_pose && scene.shown.camera.from[2] === 0');
  await end();
});

test('frames are chosen and played', async () => {
  write('film.scene', plain().replace('render {', 'animation { frames: 1 .. 5, fps: 50 }\nrender {')
      .replace('(0, 0, 0), radius', '(time / 1s, 0, 0), radius'));
  const { page, end } = await serve('film.scene');
  await page.$eval('#frame', (slider) => {
    slider.value = 3;
    slider.dispatchEvent(new Event('input'));
  });
  await page.waitForFunction('scene.frame === 3');
  assert.match(await text(page, 'command'), /--frames=3$/);
  await page.click('#play');
  await page.waitForFunction('scene.frame === 5');
  await page.waitForFunction('scene.frame === 1');
  await page.click('#play');
  assert.equal(await page.$eval('#play', (button) => button.getAttribute('aria-pressed')), 'false');
  await end();
});

test('channels, exposure, pixels and files', async () => {
  write('a.scene', plain('#808080'));
  const { page, url, end } = await serve('a.scene');
  await page.select('#channel', 'normal');
  await page.waitForFunction("picture.header.channel === 'normal' && picture.header.has_channel");
  const [, , blue] = await codeAt(page, 40, 20);
  assert.ok(blue > 250, 'it faces the camera');
  await page.select('#channel', 'color');
  await page.$eval('#exposure', (field) => {
    field.value = 10;
    field.dispatchEvent(new Event('change'));
  });
  await page.waitForFunction('picture.header.exposure === 10');
  assert.deepEqual(await codeAt(page, 2, 2), [255, 255, 255]);
  await clickPixel(page, 40, 20);
  await page.waitForFunction("document.getElementById('pixel').innerText.includes('radiance 1 0 0')");
  for (const [name, type] of [['picture.png', '\x89PNG'], ['picture.exr', '\x76\x2f\x31\x01']]) {
    const answer = await fetch(url + name);
    assert.equal(answer.status, 200);
    assert.equal(Buffer.from(await answer.arrayBuffer()).toString('latin1').slice(0, 4), type);
  }
  await end();
});

test('keys alone are enough', async () => {
  write('a.scene', plain());
  const { page, end } = await serve('a.scene');
  const reached = new Set();
  for (let i = 0; i < 60; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate('document.activeElement.id || document.activeElement.tagName'));
  }
  for (const id of ['fit', 'orbit', 'channel', 'exposure', 'canvas', 'param-size', 'param-tint', 'camera', 'png', 'exr'])
    assert.ok(reached.has(id), `${id}: ${[...reached]}`);
  await page.focus('#canvas');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  await page.waitForFunction("document.getElementById('sphere').innerText.includes('“ball”')");
  await page.waitForFunction("document.getElementById('pixel').innerText.startsWith('41, 20')");
  const scale = await page.evaluate('view.scale');
  await page.keyboard.press('+');
  assert.ok(await page.evaluate('view.scale') > scale);
  const left = await page.evaluate('view.x');
  await page.keyboard.press('d');
  assert.ok(await page.evaluate('view.x') < left);
  await page.keyboard.press('?');
  assert.ok(await page.$eval('#keys', (dialog) => dialog.open));
  await page.keyboard.press('Escape');
  assert.ok(!await page.$eval('#keys', (dialog) => dialog.open));
  await end();
});

for (const scheme of ['light', 'dark']) {
  test(`a screen of 360 pixels needs no scrolling sideways, ${scheme}`, async () => {
    write('a.scene', plain());
    const { page, end } = await serve('a.scene', { width: 360, height: 740, scheme });
    assert.ok(await page.evaluate('document.documentElement.scrollWidth') <= 360);
    await clickPixel(page, 40, 20);
    assert.ok(await page.evaluate('document.documentElement.scrollWidth') <= 360);
    const [toolsEnd, canvasEnd, panelStart] = await page.evaluate(
        "['tools', 'view', 'panel'].map((id, i) => document.getElementById(id).getBoundingClientRect()[i < 2 ? 'bottom' : 'top'])");
    assert.ok(toolsEnd < canvasEnd && canvasEnd <= panelStart + 1, 'nothing overlaps');
    await end();
  });
}

test('an editor shows texts that are not saved, its cursor, and clicks', async () => {
  write('a.scene', plain());
  const program = spawn(process.env.SDLC, ['serve', 'a.scene', '--editor'], { cwd: folder, stdio: ['pipe', 'pipe', 'inherit'] });
  const said = [];
  let rest = '';
  program.stdout.on('data', (data) => {
    const lines = (rest + data).split('\n');
    rest = lines.pop();
    said.push(...lines.map((line) => JSON.parse(line)));
  });
  const say = (message) => program.stdin.write(`${JSON.stringify({ path: join(folder, 'a.scene'), ...message })}\n`);
  const until = async (isTrue) => { while (!isTrue()) await new Promise((resolve) => setTimeout(resolve, 20)); };
  say({ type: 'text', text: plain('black') });
  await until(() => said.length > 0);
  assert.equal(said[0].type, 'url');
  const context = await browser.createBrowserContext();
  const page = await newPage(context);
  await page.goto(said[0].url);
  await page.waitForFunction('picture && picture.header.is_finished');
  assert.deepEqual(await codeAt(page, 2, 2), [0, 0, 0], 'the text of the editor');

  const line = plain().split('\n').findIndex((l) => l.includes('sphere ball')) + 1;
  say({ type: 'cursor', line, column: 20 });
  await page.waitForFunction('outline && outline.rows.length > 5');
  const inside = await page.evaluate('outline.rows.every(([x, y]) => Math.hypot(x - 40, y - 20) < 10)');
  assert.ok(inside, 'around the ball');
  say({ type: 'cursor', line: 1, column: 1 });
  await page.waitForFunction('outline.rows.length === 0');

  await clickPixel(page, 40, 20);
  await until(() => said.length > 1);
  const place = { type: 'open', path: join(folder, 'a.scene'), line, column: 3 };
  assert.deepEqual(said[1], place);
  await page.click('#sphere a');
  await until(() => said.length > 2);
  assert.deepEqual(said[2], place);
  await page.evaluate("send({type: 'open', place: {path: '/etc/passwd', line: 1, column: 1}})");
  await page.evaluate("send({type: 'open', place: {path: 7}})");
  say({ type: 'text', text: plain('#00ff00') });
  await page.waitForFunction('picture.header.scene === 2 && picture.header.is_finished');
  assert.deepEqual(await codeAt(page, 2, 2), [0, 255, 0]);
  say({ type: 'text', text: null });
  await page.waitForFunction('picture.header.scene === 3 && picture.header.is_finished');
  assert.deepEqual(await codeAt(page, 2, 2), [255, 255, 255], 'the file counts again');
  assert.equal(said.length, 3, 'no file but those of the scene');
  await context.close();
  program.stdin.end();
  await new Promise((resolve) => program.once('exit', resolve));
});

test('a second window is welcome, and nothing is rendered while none is seen', async () => {
  write('a.scene', plain().replace('samples: 16', 'samples: 16777216'));
  const program = spawn(process.env.SDLC, ['serve', 'a.scene'], { cwd: folder, stdio: ['ignore', 'pipe', 'inherit'] });
  const url = await new Promise((resolve) => program.stdout.once('data', (data) => resolve(String(data).trim())));
  const contexts = [await browser.createBrowserContext(), await browser.createBrowserContext()];
  const pages = await Promise.all(contexts.map(newPage));
  for (const page of pages) await page.goto(url);
  for (const page of pages) await page.waitForFunction('picture');
  await pages[0].evaluate("choose({params: {size: '2'}})");
  for (const page of pages) await page.waitForFunction("scene.params[0].value === '2'");
  await contexts[0].close();
  await pages[1].evaluate("send({type: 'visible', value: false})");
  await pages[1].waitForFunction('progress.is_paused');
  const seconds = () => Number(readFileSync(`/proc/${program.pid}/stat`, 'utf8').split(' ')[13]) / 100;
  const start = seconds();
  await new Promise((resolve) => setTimeout(resolve, 1000));
  assert.ok(seconds() - start < 0.3, `${seconds() - start} s of a processor`);
  await pages[1].evaluate('sendVisibility()');
  await pages[1].waitForFunction('progress.is_running && !progress.is_paused');
  await contexts[1].close();
  program.kill();
  await new Promise((resolve) => program.once('exit', resolve));
});
