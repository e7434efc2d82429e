// Pictures of scenes, rendered by the program and kept until the scene, what it reads, or the program changes.
import { execFile } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { promisify } from 'node:util';

const run = promisify(execFile);

// What bounds the time of a build: each picture ends at this error or after this time.
const settings = ['--width', '800', '--error', '2%', '--time', '10s', '--denoise'];
const silent = ['--stats', '-', '--progress', 'none', '--quiet'];

export class Renderer {
  /** Scenes are found from `folder`. */
  constructor(program, folder, cache) {
    Object.assign(this, { program, folder, cache });
    this.programHash = createHash('sha256').update(readFileSync(program)).digest('hex');
    mkdirSync(cache, { recursive: true });
  }

  async ask(...args) {
    const { stdout } = await run(this.program, args, { cwd: this.folder, maxBuffer: 1 << 26 });
    return stdout;
  }

  /** A frame with some motion in it: a quarter of the way through an animation. */
  async frameOf(scene) {
    const { animation } = JSON.parse(await this.ask('inspect', scene, '--format', 'json'));
    if (!animation) return [];
    const frame = animation.first + Math.floor(animation.count / 4) * animation.step;
    return ['--frames', `${frame}-${frame}`];
  }

  /** { picture, command, dependencies, stats } of a scene; `picture` is a file of the cache. */
  async render(scene) {
    const dependencies = (await this.ask('inspect', scene, '--deps')).trim().split('\n');
    const hash = createHash('sha256').update(JSON.stringify([this.programHash, settings]));
    for (const file of dependencies) hash.update(file).update(readFileSync(join(this.folder, file)));
    const key = hash.digest('hex');

    const name = basename(scene, '.scene');
    const picture = join(this.cache, `${name}.png`);
    const record = join(this.cache, `${name}.json`);
    if (existsSync(record) && existsSync(picture)) {
      const known = JSON.parse(readFileSync(record, 'utf8'));
      if (known.key === key) return { ...known, picture };
    }
    console.error(`site: rendering ${scene}`);
    const args = ['render', scene, ...settings, ...(await this.frameOf(scene))];
    const stats = JSON.parse(await this.ask(...args, ...silent, '-o', picture));
    const command = ['sdlc', ...args, '-o', `${name}.png`].join(' ');
    const made = { key, command, dependencies, stats };
    // Written last, so that an interrupted render is repeated.
    writeFileSync(record, JSON.stringify(made));
    return { ...made, picture };
  }
}

/** The first paragraph of the first doc comment of a scene. */
export function descriptionOf(text) {
  const lines = /^(\/\/\/.*\n)+/m.exec(text)?.[0].split('\n') ?? [];
  const words = lines.map((line) => line.replace(/^\/\/\/ ?/, ''));
  const end = words.indexOf('');
  return words.slice(0, end < 0 ? undefined : end).join(' ');
}
