// A project as text: the fragment of a link is a version byte and deflated JSON, in base64url.
const kVersion = 1;
/** Longer links are cut by mail programs and chats. */
export const kMaxLink = 30_000;

async function through(bytes, stream) {
  const writer = stream.writable.getWriter();
  // Reading tells what is wrong.
  writer.write(bytes).catch(() => {});
  writer.close().catch(() => {});
  const chunks = [];
  const reader = stream.readable.getReader();
  for (let part; !(part = await reader.read()).done; ) chunks.push(part.value);
  return new Uint8Array(await new Blob(chunks).arrayBuffer());
}

const toBase64 = (bytes) => {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
};
const fromBase64 = (text) =>
  Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));

export async function toFragment(project) {
  const json = new TextEncoder().encode(JSON.stringify(project));
  const packed = await through(json, new CompressionStream('deflate-raw'));
  return toBase64(new Uint8Array([kVersion, ...packed]));
}

/** Throws if the text is damaged or of a later version. */
export async function fromFragment(text) {
  const [version, ...packed] = fromBase64(text);
  if (version !== kVersion) throw new Error('it is of a later version of this page');
  const json = await through(new Uint8Array(packed), new DecompressionStream('deflate-raw'));
  const project = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(json));
  if (!isProject(project)) throw new Error('it has no scene');
  return project;
}

/** Names of files, with folders. */
export const isName = (name) => /^\w[\w.-]*(\/\w[\w.-]*)*$/.test(name);
/** Whether a file is a folder of another one. */
export const areMixed = (names) => names.some((name) => names.some((other) => other.startsWith(`${name}/`)));

/** {files: {name: text}, main: name, settings: {width, error}, choices: those of the picture's page} */
export const isProject = (value) =>
  Object.entries(value?.files ?? {}).every(([name, text]) => isName(name) && typeof text === 'string') &&
  !areMixed(Object.keys(value?.files ?? {})) &&
  Object.hasOwn(value?.files ?? {}, value.main) &&
  typeof (value.settings ?? {}) === 'object' &&
  typeof (value.choices ?? {}) === 'object';
