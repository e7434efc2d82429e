// Keeps the playground for use without a network, and adds the headers that threads need, for servers that do not send
// them. The build writes the list of files; what else is loaded is kept when it is loaded.
/* global FILES, VERSION */
const kCache = `sdlc-playground-${VERSION}`;
const scope = new URL('./', location);

self.addEventListener('install', (event) => {
  const requests = FILES.map((name) => new Request(name, { cache: 'no-cache' })); // as new as the server's
  event.waitUntil(caches.open(kCache).then((cache) => cache.addAll(requests)));
});

self.addEventListener('activate', (event) => {
  const clear = async () => {
    for (const name of await caches.keys()) {
      if (name.startsWith('sdlc-playground-') && name !== kCache) await caches.delete(name);
    }
    await self.clients.claim();
  };
  event.waitUntil(clear());
});

self.addEventListener('message', ({ data }) => {
  if (data === 'replace') self.skipWaiting();
});

/** `event` is kept alive until the answer is kept. A browser that keeps nothing only loads. */
async function answer(event) {
  const { request } = event;
  const cache = await caches.open(kCache);
  const url = new URL(request.url).pathname === scope.pathname ? new URL('index.html', scope) : request;
  let response = await cache.match(url, { ignoreSearch: true });
  if (!response) {
    // As new as the scripts that use it.
    response = await (request.mode === 'navigate' ? fetch(request) : fetch(request, { cache: 'no-cache' }));
    const isOurs = request.method === 'GET' && request.url.startsWith(scope);
    if (isOurs && response.status === 200) event.waitUntil(cache.put(url, response.clone()).catch(() => {}));
  }
  if (response.type === 'opaque' || response.type === 'error') return response;
  const headers = new Headers(response.headers);
  headers.set('Cross-Origin-Opener-Policy', 'same-origin');
  headers.set('Cross-Origin-Embedder-Policy', 'require-corp');
  const { status, statusText } = response;
  return new Response([204, 304].includes(status) ? null : response.body, { status, statusText, headers });
}

self.addEventListener('fetch', (event) => {
  if (new URL(event.request.url).origin === location.origin) event.respondWith(answer(event));
});
