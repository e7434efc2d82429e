// The connection of the picture's page to the playground around it, in place of the WebSocket of `sdlc serve`.
'use strict';

globalThis.openConnection = () => {
  const connection = { readyState: WebSocket.CONNECTING, send() {} };
  if (window.parent === window) return connection;
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = ({ data }) =>
    connection.onmessage({ data: data instanceof ArrayBuffer ? data : JSON.stringify(data) });
  connection.send = (text) => port1.postMessage(JSON.parse(text));
  connection.readyState = WebSocket.OPEN;
  window.parent.postMessage('picture', '*', [port2]);
  queueMicrotask(() => connection.onopen());
  return connection;
};

// There is no server that writes the file; the canvas has the codes of the picture.
document.addEventListener('click', async (event) => {
  if (event.target.id !== 'png') return;
  event.preventDefault();
  if (!picture) return;
  const blob = await new Promise((resolve) => picture.image.toBlob(resolve));
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = event.target.download;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
});
