// How the page is loaded: its service worker and the module of the engine.
import { notify } from './page.js';

/**
 * The service worker keeps the page for use without a network, and lets it use threads: for that, the page is loaded
 * once more, unless `isInUse()`. Resolves when it serves, or if there is none.
 */
export async function startServiceWorker(isInUse) {
  const workers = navigator.serviceWorker;
  if (!workers) return;
  const offer = (worker) => {
    notify('A new version of the playground is there.', ['Load it', () => worker.postMessage('replace')]);
    workers.addEventListener('controllerchange', () => location.reload(), { once: true });
  };
  const register = async () => {
    const registration = await workers.register('service-worker.js');
    if (registration.waiting) offer(registration.waiting);
    registration.addEventListener('updatefound', () => {
      const { installing } = registration;
      installing.addEventListener('statechange', () => {
        if (installing.state === 'installed' && workers.controller) offer(installing);
      });
    });
  };
  const hasFailed = register().then(() => new Promise(() => {}), () => true);
  const serves = new Promise((resolve) => workers.addEventListener('controllerchange', () => resolve(false), { once: true }));
  if (!workers.controller && (await Promise.race([hasFailed, serves]))) return;
  // Once, because a browser may not let it, and not while somebody writes. A reload would leave this page in the
  // browser's cache, where "back" would find it.
  const query = new URLSearchParams(location.search);
  if (!crossOriginIsolated && !query.has('again') && !isInUse()) {
    query.set('again', '');
    location.replace(`?${query}${location.hash}`);
    await new Promise(() => {});
  }
}

/** The module of a file beside the page. */
export async function compile(name) {
  const response = await fetch(name);
  if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
  // Not all servers know the type.
  const isTyped = response.headers.get('content-type')?.startsWith('application/wasm');
  return isTyped ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}
