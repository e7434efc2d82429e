// How long `sdlc serve` takes from a save to the first pixels, and to an error of 5 % (or --error).
//
//     SDLC_NODE_MODULES=build/release/node/node_modules node bench/serve_latency.mjs build/release/bin/sdlc \
//         [--saves 100] [--width 480] [--error 5] SCENE...
//
// A client receives pictures as the page does. Each save appends a sphere below the scene, in another place, so that
// all is compiled and rendered anew; the next one follows when the error is reached, or all samples are there. Prints
// the median and the 95th percentile, in milliseconds; the memory of the program after a tenth of the saves, and at the
// end; and the seconds of a processor that it takes in 10 s without a save.
import { spawn } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { basename, dirname, join, resolve } from 'node:path';

const require = createRequire(join(process.env.SDLC_NODE_MODULES, 'bench.cjs'));
const { WebSocket } = require('ws');

const [program, ...words] = process.argv.slice(2);
function option(name, usual) {
  const flag = words.indexOf(name);
  return flag < 0 ? usual : Number(words.splice(flag, 2)[1]);
}
const saves = option('--saves', 100), width = option('--width', 480);
const goal = option('--error', 5) / 100;

const resident = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))[1]) / 1024;
const processorSeconds = (pid) => {
  const fields = readFileSync(`/proc/${pid}/stat`, 'utf8').split(') ')[1].split(' ');
  return (Number(fields[11]) + Number(fields[12])) / 100;
};
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
const percentile = (values, share) => [...values].sort((a, b) => a - b)[Math.ceil(share * values.length) - 1];

async function measure(scene) {
  const folder = mkdtempSync(join(tmpdir(), 'sdlc-latency-'));
  cpSync(dirname(resolve(scene)), folder, { recursive: true });  // with its imports
  const file = join(folder, basename(scene));
  const text = readFileSync(file, 'utf8');
  const child = spawn(resolve(program), ['serve', file, `--width=${width}`], { stdio: ['ignore', 'pipe', 'inherit'] });
  const url = new URL(await new Promise((done) => child.stdout.once('data', (data) => done(String(data).trim()))));
  const socket = new WebSocket(`ws://${url.host}${url.pathname}live`, { origin: url.origin, perMessageDeflate: false });
  let onPicture;
  socket.on('message', (data, isBinary) => {
    if (!isBinary) return;
    socket.send('{"type":"shown"}');
    onPicture?.(JSON.parse(data.subarray(4, 4 + data.readUInt32LE(0))));
  });
  const reached = (after) => new Promise((done) => {
    let first = 0;
    onPicture = (header) => {
      if (header.scene <= after) return;
      first ||= performance.now();
      const isReached = header.error && header.error.to <= goal;
      if (isReached || header.is_finished) done({ first, end: performance.now(), scene: header.scene, isReached });
    };
  });
  let { scene: number } = await reached(0);
  const first = [], end = [];
  let memory = 0, missed = 0;
  for (let i = 0; i < saves; ++i) {
    if (i === Math.floor(saves / 10)) memory = resident(child.pid);
    const next = reached(number);
    const start = performance.now();
    writeFileSync(file, `${text}\nsphere { center: (0, -${50 + i / 100}, 0), radius: 1, material: unlit(color: black) }\n`);
    const times = await next;
    number = times.scene;
    first.push(times.first - start);
    end.push(times.end - start);
    if (!times.isReached) ++missed;
  }
  const memoryAtEnd = resident(child.pid);
  await sleep(100);
  socket.send('{"type":"visible","value":false}');
  await sleep(500);
  const before = processorSeconds(child.pid);
  await sleep(10_000);
  const idle = processorSeconds(child.pid) - before;
  socket.close();
  child.kill();
  rmSync(folder, { recursive: true });
  const of = (values) => `${percentile(values, 0.5).toFixed(0)} / ${percentile(values, 0.95).toFixed(0)}`;
  console.log(`| ${basename(scene, '.scene')} | ${of(first)} | ${of(end)}${missed ? ` (${missed} finished before)` : ''} | ` +
              `${memory.toFixed(0)} → ${memoryAtEnd.toFixed(0)} | ${idle.toFixed(2)} |`);
}

console.log(`| scene | first pixels, ms | error of ${100 * goal} %, ms | MB | idle, s of 10 |`);
console.log('| --- | --- | --- | --- | --- |');
for (const scene of words) await measure(scene);
