'use strict';
// The page of `sdlc serve`. docs/serve.md describes the messages.

const byId = (id) => document.getElementById(id);
const canvas = byId('canvas');
const paint = canvas.getContext('2d');

let scene = null;      // the last message about the scene
let picture = null;    // {header, image}: the newest; `image` is a canvas
let before = null;     // the same of the version before the last change
let progress = null;
let socket = null;
const sent = {channel: 'color', exposure: 0};
const view = {scale: 1, x: 0, y: 0, isFitted: true};  // screen pixels per pixel; place of the corner
const mark = {x: 0, y: 0, isShown: false};            // the pixel that keys move
let isOrbiting = false;
let isComparing = false;

// Messages

function send(message) {
  if (socket && socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
}

function connect() {
  // The playground of the site has no server: its connection is to a worker.
  socket = globalThis.openConnection?.() ?? new WebSocket(new URL('live', location.href.replace('http', 'ws')));
  socket.binaryType = 'arraybuffer';
  socket.onopen = () => {
    sendVisibility();
    sendView();
  };
  socket.onmessage = ({data}) => {
    if (typeof data !== 'string') return takePicture(data);
    const message = JSON.parse(data);
    ({scene: takeScene, progress: takeProgress, picked: takePicked, pixel: takePixel,
      failure: takeFailure, outline: takeOutline})[message.type]?.(message);
  };
  socket.onclose = () => {
    isAnswered = true;
    setStatus('not connected: sdlc has ended, or is not to be reached', true);
    setTimeout(connect, 1000);
  };
}

// What a frame of an editor would forget when it is hidden.
function keepView() {
  try {
    sessionStorage.setItem('view', JSON.stringify({...sent, ...view}));
  } catch {
    // The browser keeps nothing.
  }
}
function restoreView() {
  try {
    const {channel, exposure, ...kept} = JSON.parse(sessionStorage.getItem('view'));
    byId('channel').value = channel;
    byId('exposure').value = exposure;
    Object.assign(view, kept);
  } catch {
    // There is none.
  }
}
window.addEventListener('pagehide', keepView);
document.addEventListener('visibilitychange', keepView);

const sendVisibility = () => send({type: 'visible', value: document.visibilityState === 'visible'});
document.addEventListener('visibilitychange', sendVisibility);

function sendView() {
  sent.channel = byId('channel').value;
  sent.exposure = Number(byId('exposure').value) || 0;
  send({type: 'view', ...sent});
}

// Choices are sent one at a time: the newest follows when the last one has been answered.
let waiting = null;
let isAnswered = true;
function choose(choice) {
  waiting = {...waiting, ...choice, params: {...waiting?.params, ...choice.params}};
  sendChoices();
}
function sendChoices() {
  if (!isAnswered || !waiting) return;
  send({type: 'choose', ...waiting});
  waiting = null;
  isAnswered = false;
}

function takeScene(message) {
  scene = message;
  isAnswered = true;
  if (!scene.is_correct || !scene.has_pose) pose = null;  // moves go on from what is shown
  document.title = `${message.name ?? 'sdlc'} – sdlc`;
  byId('name').textContent = message.name ?? 'sdlc';
  byId('command').textContent = message.command;
  const stem = (message.name ?? 'picture').replace(/^.*\//, '').replace(/\.[^.]*$/, '');
  for (const format of ['png', 'exr']) byId(format).download = `${stem}.${format}`;
  showFindings();
  showParams();
  showFrames();
  showCameras();
  showStatus();
  sendChoices();
  // The text may have other lines now, and the place another sphere.
  if (scene.is_correct && !byId('sphere').hidden) pick(mark.x, mark.y, opensPicked);
  if (scene.is_correct !== wasCorrect) announce(scene.is_correct ? 'The scene is correct' : `${scene.errors} errors`);
  wasCorrect = scene.is_correct;
}
let wasCorrect = true;

// For users of screen readers: what others see.
function announce(text) {
  byId('announcement').textContent = text;
}

function takePicture(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const codes = new Uint8Array(buffer, 4 + length);
  if (picture && picture.header.scene !== header.scene && !picture.isFirstLook) before = picture;
  const image = document.createElement('canvas');
  image.width = header.width;
  image.height = header.height;
  const data = new ImageData(header.width, header.height);
  for (let i = 0, j = 0; j < data.data.length; i += 3, j += 4) {
    data.data[j] = codes[i];
    data.data[j + 1] = codes[i + 1];
    data.data[j + 2] = codes[i + 2];
    data.data[j + 3] = 255;
  }
  image.getContext('2d').putImageData(data, 0, 0);
  const needsFit = picture ? picture.header.full_width !== header.full_width ||
                                  picture.header.full_height !== header.full_height
                                : view.isFitted;
  picture = {header, image, isFirstLook: header.width !== header.full_width || header.height !== header.full_height};
  byId('compare').disabled = !before;
  if (needsFit) fit();
  draw();
  showStatus();
  showWarnings();
  send({type: 'shown'});
  if (header.is_finished) byId('progress').value = 1;
  if (lastPixel) askForPixel(lastPixel.x, lastPixel.y);
}

function takeProgress(message) {
  progress = message;
  byId('progress').value = message.is_running ? message.share : picture?.header.is_finished ? 1 : 0;
  showStatus();
}

let failure = null;  // why the render of a scene has ended: {scene, text}
function takeFailure(message) {
  failure = message;
  showStatus();
}

// Status

function setStatus(text, isError) {
  byId('status').textContent = text;
  byId('status').classList.toggle('error', Boolean(isError));
}

function percent(share) {
  return `${Number((100 * share).toPrecision(3))} %`;
}

function duration(seconds) {
  if (seconds < 90) return `${Math.ceil(seconds)} s`;
  if (seconds < 5400) return `${Math.ceil(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}

const channelName = (value) => byId('channel').querySelector(`[value=${value}]`).textContent.replace(/:.*/, '');

function showStatus() {
  if (!scene) return;
  const parts = [];
  if (!scene.is_correct) {
    const count = `${scene.errors} error${scene.errors === 1 ? '' : 's'}`;
    parts.push(scene.errors ? count : 'the scene cannot be rendered');
    if (picture) parts[0] += '; the picture is of the last correct version';
  }
  if (failure?.scene === scene.scene) parts.push(failure.text);
  const header = (isComparing ? before : picture)?.header;
  if (isComparing) parts.push('before the last change');
  if (isComparing && header.channel !== sent.channel) parts.push(`as ${channelName(header.channel)}`);
  if (isComparing && header.exposure !== sent.exposure) parts.push(`at exposure ${header.exposure}`);
  if (header && !header.has_channel) {
    const why = header.is_finished ? 'the picture is too large for' : 'the next picture has';
    parts.push(`${why} ${channelName(header.channel)}`);
  }
  if (header) {
    if (!isComparing && picture.isFirstLook) parts.push('first look');
    else parts.push(header.samples);
    if (header.error) {
      const of = ({value, from, to}) => `${percent(value)} (${percent(from)} to ${percent(to)})`;
      const plain = header.plain_error ? `${percent(header.plain_error.value)} → ` : '';
      parts.push(`error ${plain}${of(header.error)}`);
    } else if (header.is_error_unknown) {
      parts.push('error unknown');
    }
  }
  if (isComparing) parts.push('pixels and clicks are of the new picture');
  else if (header?.is_finished && header.scene === scene.scene) parts.push('finished');  // progress comes later
  else if (progress?.is_paused) parts.push('paused');
  else if (progress?.is_stopped) parts.push('stopped');
  else if (progress?.is_running && progress.seconds_left != null)
    parts.push(`${duration(progress.seconds_left)} left`);
  setStatus(parts.join(', '), !scene.is_correct || failure?.scene === scene.scene);
}

// Texts and places

function element(tag, text, attributes = {}) {
  const made = document.createElement(tag);
  if (text != null) made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

const editorUrl = ({path, line, column}) =>
    `vscode://file${path.split('/').map(encodeURIComponent).join('/')}:${line}:${column}`;

function openPlace(place) {
  if (scene.has_editor) send({type: 'open', place});
  else location.href = editorUrl(place);
}

// A link that opens the editor.
function placeLink(place) {
  const text = `${place.file}:${place.line}:${place.column}`;
  const href = scene.has_editor ? '#' : editorUrl(place);
  const link = element('a', text, {href});
  if (scene.has_editor) {
    link.addEventListener('click', (event) => {
      event.preventDefault();
      openPlace(place);
    });
  }
  return link;
}

let shownFindings = '';
function showFindings() {
  const findings = JSON.stringify([scene.failure, scene.findings]);
  if (findings === shownFindings) return;  // a link may have the focus
  shownFindings = findings;
  const list = byId('findings');
  list.replaceChildren();
  if (scene.failure) list.append(element('pre', scene.failure));
  for (const finding of scene.findings) {
    const article = element('article', null, {class: finding.severity});
    article.append(element('pre', finding.text));
    if (finding.place) article.append(placeLink(finding.place));
    list.append(article);
  }
}

// What the picture on display lacks.
function showWarnings() {
  const list = byId('warnings');
  const warnings = picture.header.warnings;
  if (list.textContent === warnings.join('')) return;
  list.replaceChildren(...warnings.map((warning) => element('p', warning)));
}

async function copy(text, button) {
  button.dataset.label ??= button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = 'Copied';
  } catch {
    button.textContent = 'Refused';
  }
  setTimeout(() => { button.textContent = button.dataset.label; }, 1200);
}
document.addEventListener('click', ({target}) => {
  const id = target.dataset?.copy;
  if (id) copy(byId(id).textContent, target);
});

// Params

// A number with its unit: {number: 3, unit: "m"}; null for other values.
function parsedNumber(text) {
  const match = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*([a-z]*|%)\s*$/i.exec(text ?? '');
  return match && {number: Number(match[1]), unit: match[2]};
}

// The range of a slider: from the type and the default, because the language gives no other.
function sliderRange({number, unit}, type) {
  if (type === 'angle' || unit === 'deg') return {min: -360, max: 360, step: 1};
  const size = Math.abs(number) || 1;
  if (unit === '' && Number.isInteger(number) && number >= 0)
    return {min: 0, max: Math.max(10, 4 * number), step: 1};
  const step = 10 ** Math.floor(Math.log10(size) - 1.5);
  return {min: number < 0 ? -4 * size : 0, max: 4 * size, step};
}

function showParams() {
  const list = byId('params').lastElementChild;
  byId('params').hidden = scene.params.length === 0;
  for (const [i, param] of scene.params.entries()) {
    let row = list.children[i];
    const shape = JSON.stringify([param.name, param.type, param.default, param.documentation]);
    if (row?.dataset.shape !== shape) {
      const made = paramRow(param);
      made.dataset.shape = shape;
      if (row) row.replaceWith(made);
      else list.append(made);
      row = made;
    }
    row.show(param);
  }
  while (list.children.length > scene.params.length) list.lastElementChild.remove();
}

function paramRow(param) {
  const row = element('div', null, {class: 'param'});
  const id = `param-${param.name}`;
  const field = element('span', null, {class: 'field'});
  const reset = element('button', 'Reset', {'aria-label': `Reset ${param.name}`});
  const set = element('code');
  const copySet = element('button', 'Copy', {'aria-label': `Copy --set ${param.name}`});
  const give = (value) => choose({params: {[param.name]: value}});
  const fields = paramFields(param, id, give);
  field.append(...fields.inputs);
  row.append(element('label', param.name, {for: id}), reset, field, set, copySet);
  if (param.documentation) row.append(element('p', param.documentation));
  reset.addEventListener('click', () => give(null));
  copySet.addEventListener('click', () => copy(set.textContent, copySet));
  row.show = ({value, default: usual}) => {
    const text = value ?? usual ?? '';
    if (!field.contains(document.activeElement)) fields.show(text);
    set.textContent = `--set ${quoted(`${param.name}=${text}`)}`;
    reset.disabled = value == null;
  };
  return row;
}

const quoted = (text) => /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;

// The inputs of a param, and a function that shows a value in them.
function paramFields(param, id, give) {
  const usual = param.type === 'string' ? null : parsedNumber(param.default);
  if (usual) {
    const range = element('input', null,
                          {type: 'range', id, ...sliderRange(usual, param.type)});
    const number = element('input', null,
                           {type: 'number', step: 'any', 'aria-label': `${param.name}${usual.unit ? ` in ${usual.unit}` : ''}`});
    const take = (input) => {
      if (input.value === '') return give(null);
      range.value = number.value = input.value;
      give(`${input.value}${usual.unit}`);
    };
    range.addEventListener('input', () => take(range));
    number.addEventListener('change', () => take(number));
    return {inputs: [range, number, element('span', usual.unit)],
            show: (text) => { range.value = number.value = parsedNumber(text)?.number ?? ''; }};
  }
  if (param.type === 'bool') {
    const box = element('input', null, {type: 'checkbox', id});
    box.addEventListener('change', () => give(String(box.checked)));
    return {inputs: [box], show: (text) => { box.checked = text === 'true'; }};
  }
  const text = element('input', null, {type: 'text', id, spellcheck: 'false'});
  text.addEventListener('change', () => give(text.value));
  if (param.type !== 'color' || !param.hex) return {inputs: [text], show: (t) => { text.value = t; }};
  const color = element('input', null, {type: 'color', 'aria-label': `${param.name}, chosen`});
  color.addEventListener('input', () => { text.value = color.value; give(color.value); });
  return {inputs: [color, text], show: (t) => {
    text.value = t;
    color.value = /^#[0-9a-f]{6}$/i.test(t) ? t : param.hex;
  }};
}

// Frames

let playing = null;  // a timer
function showFrames() {
  const animation = scene.animation;
  byId('frames').hidden = !animation;
  if (!animation) return stopPlaying();
  const slider = byId('frame');
  slider.min = animation.first;
  slider.max = animation.last;
  slider.step = animation.step;
  if (document.activeElement !== slider) slider.value = scene.frame ?? animation.first;
  byId('frame-number').textContent = scene.frame ?? animation.first;
}
byId('frame').addEventListener('input', ({target}) => {
  byId('frame-number').textContent = target.value;
  choose({frame: Number(target.value)});
});

function stopPlaying() {
  clearTimeout(playing);
  playing = null;
  byId('play').setAttribute('aria-pressed', 'false');
}
function play() {
  if (!scene?.animation) return;
  if (playing) return stopPlaying();
  byId('play').setAttribute('aria-pressed', 'true');
  const step = () => {
    // The next frame begins when this one has been seen.
    if (isAnswered && picture?.header.scene === scene.scene) {
      const {first, last, step: by} = scene.animation;
      const next = (scene.frame ?? first) + by;
      byId('frame').value = next > last ? first : next;
      choose({frame: Number(byId('frame').value)});
    }
    playing = setTimeout(step, 1000 / scene.animation.fps);
  };
  step();
}
byId('play').addEventListener('click', play);

// Cameras

function showCameras() {
  const camera = scene.shown?.camera;
  const names = scene.cameras;
  const hasChoice = names.length > 1 || scene.camera;
  byId('cameras').hidden = !camera && !hasChoice;
  byId('camera-choice').hidden = !hasChoice;
  const select = byId('camera');
  if (document.activeElement !== select) {
    select.replaceChildren(element('option', 'of the scene', {value: ''}),
                           ...names.map((name) => element('option', name, {value: name})));
    select.value = scene.camera ?? '';
  }
  byId('camera-text').textContent = camera?.text ?? '';
  byId('camera-back').hidden = !scene.has_pose;
}
byId('camera').addEventListener('change', ({target}) => {
  pose = null;
  choose({camera: target.value || null, pose: null});
});
byId('camera-back').addEventListener('click', () => {
  pose = null;
  choose({pose: null});
});

const add = (a, b) => a.map((x, i) => x + b[i]);
const scaled = (a, s) => a.map((x) => x * s);
const minus = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => {
  const size = Math.max(...a.map(Math.abs)) || 1;
  const small = scaled(a, 1 / size);
  return scaled(small, 1 / Math.hypot(...small));
};
// `a` turned about the unit axis (Rodrigues).
const turned = (a, axis, angle) =>
    add(add(scaled(a, Math.cos(angle)), scaled(cross(axis, a), Math.sin(angle))),
        scaled(axis, dot(axis, a) * (1 - Math.cos(angle))));

let pose = null;   // the newest that was chosen; null: that of the scene
let reach = null;  // the distance from the camera to its point before it was moved
const poseNow = () => pose ?? (scene?.shown?.camera && {from: scene.shown.camera.from, at: scene.shown.camera.at});

function movePose(change) {
  const now = poseNow();
  if (!now) return;
  if (!scene.has_pose) reach = Math.hypot(...minus(now.from, now.at));
  pose = change(now, unit(scene.shown.camera.up));
  choose({pose});
}
const orbitBy = (right, upward) => movePose(({from, at}, up) => {
  const offset = turned(minus(from, at), up, -right);
  const side = unit(cross(up, offset));
  const tilted = turned(offset, side, -upward);
  // Not over the pole, where the picture would turn over.
  const height = (v) => Math.abs(dot(unit(v), up));
  const isNearPole = height(tilted) > 0.999 && height(tilted) > height(offset);
  return {from: add(at, isNearPole ? offset : tilted), at};
});
const dollyBy = (factor) => movePose(({from, at}) => {
  const offset = minus(from, at);
  const distance = Math.hypot(...offset);
  // Far enough for any look, and the way back is not too long.
  const wanted = Math.min(1e3 * reach, Math.max(1e-3 * reach, distance * factor));
  return {from: add(at, scaled(offset, wanted / distance)), at};
});
const slideBy = (right, upward) => movePose(({from, at}, up) => {
  const offset = minus(from, at);
  const side = unit(cross(up, offset));
  const above = unit(cross(offset, side));
  const distance = Math.hypot(...offset);
  const shift = add(scaled(side, -right * distance), scaled(above, upward * distance));
  return {from: add(from, shift), at: add(at, shift)};
});

function setOrbiting(value) {
  isOrbiting = value;
  byId('orbit').setAttribute('aria-pressed', String(value));
  canvas.classList.toggle('orbiting', value);
}

// Drawing

const screenScale = () => window.devicePixelRatio || 1;

function fit() {
  if (!picture) return;
  const {full_width: width, full_height: height} = picture.header;
  view.scale = Math.min(canvas.clientWidth / width, canvas.clientHeight / height);
  view.x = (canvas.clientWidth - width * view.scale) / 2;
  view.y = (canvas.clientHeight - height * view.scale) / 2;
  view.isFitted = true;
}

function zoomBy(factor, x = canvas.clientWidth / 2, y = canvas.clientHeight / 2) {
  const scale = Math.min(256, Math.max(0.01, view.scale * factor));
  view.x = x - (x - view.x) * scale / view.scale;
  view.y = y - (y - view.y) * scale / view.scale;
  view.scale = scale;
  view.isFitted = false;
  draw();
}

let outline = null;  // {step, rows: [[x, y, width], …]}: of the spheres at the editor's cursor
function takeOutline(message) {
  outline = message;
  draw();
}

let isDrawing = false;
function draw() {
  if (isDrawing) return;
  isDrawing = true;
  requestAnimationFrame(() => {
    isDrawing = false;
    const ratio = screenScale();
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    paint.setTransform(ratio, 0, 0, ratio, 0, 0);
    paint.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    const shown = isComparing ? before : picture;
    if (!shown) return;
    const {full_width: w, full_height: h} = shown.header;
    paint.imageSmoothingEnabled = view.scale * ratio < 2 || shown.isFirstLook;
    paint.drawImage(shown.image, view.x, view.y, w * view.scale, h * view.scale);
    if (outline && !isComparing) {
      paint.fillStyle = '#ff00c8';
      for (const [x, y, width] of outline.rows)
        paint.fillRect(view.x + x * view.scale, view.y + y * view.scale, width * view.scale,
                       outline.step * view.scale);
    }
    if (mark.isShown) {
      const size = Math.max(view.scale, 5);
      const x = view.x + (mark.x + 0.5) * view.scale, y = view.y + (mark.y + 0.5) * view.scale;
      for (const [color, grow] of [['#000', 2], ['#fff', 0]]) {
        paint.strokeStyle = color;
        paint.strokeRect(x - size / 2 - grow / 2, y - size / 2 - grow / 2, size + grow, size + grow);
      }
    }
  });
}
new ResizeObserver(() => {
  if (view.isFitted) fit();
  draw();
}).observe(canvas);

// Pixels

function pixelAt(event) {
  const box = canvas.getBoundingClientRect();
  return {x: Math.floor((event.clientX - box.left - view.x) / view.scale),
          y: Math.floor((event.clientY - box.top - view.y) / view.scale)};
}

const isInside = ({x, y}) =>
    picture && x >= 0 && y >= 0 && x < picture.header.full_width && y < picture.header.full_height;

let lastPixel = null;  // that the line below the picture is about
let pixelTimer = null;
function askForPixel(x, y) {
  if (!isInside({x, y})) return;
  lastPixel = {x, y};
  pixelTimer ??= setTimeout(() => {
    pixelTimer = null;
    send({type: 'pixel', ...lastPixel});
  }, 40);
}

const short = (x) => Number(x.toPrecision(4));
const shorts = (list) => list.map(short).join(' ');

function takePixel(message) {
  if (!message.radiance) {
    byId('pixel').textContent = `${message.x}, ${message.y}`;
    return;
  }
  const parts = [`${message.x}, ${message.y}`, `radiance ${shorts(message.radiance)}`, `codes ${message.codes.join(' ')}`];
  if (message.standard_error) parts.push(`standard error ${shorts(message.standard_error)}`);
  if (message.normal) {
    parts.push(message.depth == null ? 'background' : `depth ${short(message.depth)}`);
    if (message.depth != null) parts.push(`normal ${shorts(message.normal)}`, `albedo ${shorts(message.albedo)}`);
  }
  parts.push(`${message.samples} sample${message.samples === 1 ? '' : 's'}`);
  byId('pixel').textContent = parts.join('  ·  ');
}

let opensPicked = false;
function pick(x, y, opens) {
  opensPicked = opens;
  send({type: 'pick', x, y});
}

function takePicked({scene: of, x, y, sphere}) {
  if (of !== scene.scene) return;  // asked again with the scene
  if (opensPicked && sphere?.place) openPlace(sphere.place);
  opensPicked = false;
  const section = byId('sphere');
  const body = section.lastElementChild;
  section.hidden = false;
  body.replaceChildren();
  announce(sphere ? `${sphere.name ?? 'a sphere'}, ${sphere.material}, line ${sphere.place?.line ?? 'unknown'}`
                  : 'the background');
  const line = (text, place) => {
    const p = element('p', text);
    if (place) p.append(' ', placeLink(place));
    body.append(p);
  };
  if (!sphere) return line(`Pixel ${x}, ${y}: the background`);
  line(`${sphere.name ? `“${sphere.name}”` : sphere.index == null ? 'Instance' : `Sphere ${sphere.index}`}, ${sphere.material}`, sphere.place);
  if (sphere.place === undefined)
    line('Its place is unknown: the scene is so large that equal groups share their spheres.');
  if (sphere.material_place) line('material', sphere.material_place);
  line(`centre ${shorts(sphere.center)}, radius ${short(sphere.radius)}, ${short(sphere.distance)} from the camera`);
  if (!sphere.chain?.length) return;
  const list = element('ol');
  for (const {text, place} of sphere.chain) {
    const item = element('li', text);
    if (place) item.append(' ', placeLink(place));
    list.append(item);
  }
  body.append(list);
}

// Pointers

const pointers = new Map();
let drag = null;
canvas.addEventListener('pointerdown', (event) => {
  if (event.button !== 0) return;
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, event);
  drag = {x: event.clientX, y: event.clientY, hasMoved: false};
});
canvas.addEventListener('pointermove', (event) => {
  const held = pointers.get(event.pointerId);
  if (!held) {
    const {x, y} = pixelAt(event);
    return askForPixel(x, y);
  }
  const dx = event.clientX - held.clientX, dy = event.clientY - held.clientY;
  if (Math.hypot(event.clientX - drag.x, event.clientY - drag.y) > 4) drag.hasMoved = true;
  if (!drag.hasMoved) return;
  if (pointers.size === 2) {  // pinch
    const [a, b] = [...pointers.values()];
    const other = a.pointerId === event.pointerId ? b : a;
    const was = Math.hypot(held.clientX - other.clientX, held.clientY - other.clientY);
    const now = Math.hypot(event.clientX - other.clientX, event.clientY - other.clientY);
    const box = canvas.getBoundingClientRect();
    zoomBy(now / was, (event.clientX + other.clientX) / 2 - box.left, (event.clientY + other.clientY) / 2 - box.top);
  } else if (isOrbiting && event.shiftKey) {
    slideBy(dx / canvas.clientHeight, dy / canvas.clientHeight);
  } else if (isOrbiting) {
    orbitBy(dx * Math.PI / canvas.clientWidth, dy * Math.PI / canvas.clientHeight);
  } else {
    view.x += dx;
    view.y += dy;
    view.isFitted = false;
    draw();
  }
  pointers.set(event.pointerId, event);
});
canvas.addEventListener('pointerup', (event) => {
  if (!pointers.has(event.pointerId)) return;
  const isClick = pointers.size === 1 && !drag.hasMoved;
  pointers.delete(event.pointerId);
  if (!isClick || !isInside(pixelAt(event))) return;
  Object.assign(mark, pixelAt(event), {isShown: true});
  pick(mark.x, mark.y, scene.has_editor);
  askForPixel(mark.x, mark.y);
  draw();
});
canvas.addEventListener('dblclick', (event) => {
  if (isInside(pixelAt(event)) && !scene.has_editor) pick(mark.x, mark.y, true);
});
canvas.addEventListener('pointercancel', (event) => pointers.delete(event.pointerId));
canvas.addEventListener('wheel', (event) => {
  event.preventDefault();
  const factor = Math.exp(-event.deltaY / 400);
  const box = canvas.getBoundingClientRect();
  if (isOrbiting) dollyBy(1 / factor);
  else zoomBy(factor, event.clientX - box.left, event.clientY - box.top);
}, {passive: false});

// Keys

function moveMark(dx, dy) {
  const header = picture?.header;
  if (!header) return;
  if (!mark.isShown) {
    mark.x = Math.floor(header.full_width / 2);
    mark.y = Math.floor(header.full_height / 2);
  }
  mark.x = Math.min(header.full_width - 1, Math.max(0, mark.x + dx));
  mark.y = Math.min(header.full_height - 1, Math.max(0, mark.y + dy));
  mark.isShown = true;
  // The mark stays in view.
  const place = (n, corner, size) => Math.min(size - 20, Math.max(20, corner + (n + 0.5) * view.scale)) - (n + 0.5) * view.scale;
  view.x = place(mark.x, view.x, canvas.clientWidth);
  view.y = place(mark.y, view.y, canvas.clientHeight);
  askForPixel(mark.x, mark.y);
  draw();
}

function setComparing(value) {
  isComparing = value && Boolean(before);
  byId('compare').setAttribute('aria-pressed', String(isComparing));
  showStatus();
  draw();
}
function addExposure(stops) {
  byId('exposure').value = Number(byId('exposure').value) + stops;
  sendView();
}
function nextChannel() {
  byId('channel').selectedIndex = (byId('channel').selectedIndex + 1) % byId('channel').length;
  sendView();
}
function showActual() {
  zoomBy(1 / screenScale() / view.scale);
}

function panBy(dx, dy) {
  view.x += dx * canvas.clientWidth / 10;
  view.y += dy * canvas.clientHeight / 10;
  view.isFitted = false;
  draw();
}

const nearer = (factor) => isOrbiting ? dollyBy(1 / factor) : zoomBy(factor);
const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
const keys = {
  '+': () => nearer(1.25), '=': () => nearer(1.25), '-': () => nearer(0.8), '0': () => { fit(); draw(); }, '1': showActual,
  a: () => panBy(1, 0), d: () => panBy(-1, 0), w: () => panBy(0, 1), s: () => panBy(0, -1),
  o: () => setOrbiting(!isOrbiting), b: () => setComparing(!isComparing), c: nextChannel,
  ']': () => addExposure(0.5), '[': () => addExposure(-0.5), ' ': play, '?': () => byId('keys').showModal(),
};
// In a frame of an editor, its own keys are for it.
function passToEditor(event) {
  if (window.parent === window || !scene?.has_editor) return false;
  const {key, code, keyCode, ctrlKey, metaKey, altKey, shiftKey} = event;
  const isOfEditor = ctrlKey || metaKey || altKey || /^F\d+$/.test(key);
  const isOfText = event.getModifierState('AltGraph') || /^[acvxyz]$/i.test(key);
  if (!isOfEditor || isOfText) return false;
  event.preventDefault();
  window.parent.postMessage({key, code, keyCode, ctrlKey, metaKey, altKey, shiftKey}, '*');
  return true;
}

document.addEventListener('keydown', (event) => {
  if (passToEditor(event)) return;
  if (event.ctrlKey || event.metaKey || event.altKey || byId('keys').open) return;
  const isOnCanvas = event.target === canvas;
  if (isOnCanvas && arrows[event.key]) {
    event.preventDefault();
    const [dx, dy] = arrows[event.key];
    if (isOrbiting && event.shiftKey) slideBy(dx * 0.05, dy * 0.05);
    else if (isOrbiting) orbitBy(dx * 0.05, dy * 0.05);
    else moveMark(dx * (event.shiftKey ? 10 : 1), dy * (event.shiftKey ? 10 : 1));
  } else if (isOnCanvas && event.key === 'Enter') {
    if (!mark.isShown) moveMark(0, 0);
    pick(mark.x, mark.y, scene.has_editor);
  } else if (isOnCanvas || event.target === document.body || (event.target.tagName === 'BUTTON' && event.key !== ' ')) {
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
});

byId('fit').addEventListener('click', () => { fit(); draw(); });
byId('actual').addEventListener('click', showActual);
byId('closer').addEventListener('click', () => zoomBy(1.25));
byId('farther').addEventListener('click', () => zoomBy(0.8));
byId('orbit').addEventListener('click', () => setOrbiting(!isOrbiting));
byId('compare').addEventListener('click', () => setComparing(!isComparing));
byId('help').addEventListener('click', () => byId('keys').showModal());
byId('channel').addEventListener('change', sendView);
byId('exposure').addEventListener('change', sendView);

restoreView();
connect();
