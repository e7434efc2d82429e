// No sdlc, a wrong one, and a workspace that is not trusted.
import { BALL, scene } from './scenes.mjs';

async function withPath(bench, path, run) {
  await bench.command('Notifications: Clear All Notifications');
  await bench.open('ball.scene', scene(BALL));
  bench.settings({ 'sdlc.path': path });
  try {
    await run();
  } finally {
    bench.settings({ 'sdlc.path': 'sdlc' });
    await bench.command('Notifications: Clear All Notifications');
  }
}

export const checks = [
  {
    name: 'a missing sdlc is reported, with how to install it',
    run: (bench) =>
      withPath(bench, 'sdlc-is-not-here', async () => {
        await bench.seeText('.notification-toast', '`sdlc-is-not-here` is not on the PATH');
        await bench.screenshot('missing');
        await bench.click('.notification-toast .monaco-button', 'How to Install');
        await bench.seeText('.tab.active', 'README.md');
      }),
  },
  {
    name: 'a path without a program is reported',
    run: (bench) =>
      withPath(bench, '~/nowhere/sdlc', () => bench.seeText('.notification-toast', `${bench.home}/nowhere/sdlc`)),
  },
  {
    name: 'an old sdlc is reported, with the version that is needed',
    run: (bench) =>
      withPath(bench, bench.program('old', 'echo "sdlc 0.0.9 (1234567)"'), async () => {
        await bench.seeText('.notification-toast', 'is sdlc 0.0.9. This extension needs 0.2.0 or later');
        await bench.screenshot('old');
      }),
  },
  {
    name: 'another program is reported',
    run: (bench) => withPath(bench, '/bin/ls', () => bench.seeText('.notification-toast', 'is another program')),
  },
  {
    name: 'a server that ends at once is reported',
    run: (bench) =>
      withPath(bench, bench.program('broken', 'if [ "$1" = --version ]; then echo "sdlc 9.9.9"; else exit 3; fi'),
        () => bench.seeText('.notification-toast', 'The language server does not start')),
  },
  {
    name: 'without a server, the schema completes configs',
    run: (bench) =>
      withPath(bench, 'sdlc-is-not-here', async () => {
        await bench.seeText('.notification-toast', 'is not on the PATH');
        await bench.open('plain.sdlc.json', '{ "saving": {}, "image": {} }\n');
        await bench.seeText('.statusbar-item', 'JSON');
        await bench.goto(1, 3);
        await bench.press('Control+ ');
        await bench.seeText('.suggest-widget .monaco-list-row .label-name', 'rendering');
      }),
  },
  {
    name: 'the server comes back when the path is correct again',
    async run(bench) {
      await bench.open('ball.scene', scene(BALL.replace('radius', 'radus')));
      await bench.see('.squiggly-error');
    },
  },
];

/** In a workspace that is not trusted, whose settings name a program. */
export const untrusted = [
  {
    name: 'an untrusted workspace: its path is ignored, and the server is in a sandbox',
    async run(bench) {
      await bench.open('ball.scene', scene(BALL.replace('radius', 'radus')));
      await bench.see('.squiggly-error');
      const servers = bench.calls().filter((call) => call.startsWith('lsp'));
      if (servers.join() !== 'lsp --sandbox') throw new Error(`the servers were: ${servers}`);
      if (bench.calls('evil').length > 0) throw new Error('the program of the workspace was run');
    },
  },
];
