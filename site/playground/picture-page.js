// The picture's page: that of `sdlc serve`, connected to the page or the editor around it.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

/** Replaces @name@ by the value of that name. */
export const fill = (text, values) => text.replace(/@(\w+)@/g, (all, name) => values[name] ?? all);

/** Its scripts and its style have the attribute nonce="@nonce@". `root`: of the repository. */
export function picturePage(root) {
  const read = (path) => readFileSync(join(root, path), 'utf8');
  return fill(read('cli/web/page.html'), {
    style: `${read('cli/web/page.css')}#exr { display: none; }\n`,
    script: `${read('site/playground/picture.js')}</script>\n<script nonce="@nonce@">\n${read('cli/web/page.js')}`,
  }).replace(/href="picture\.(png|exr)"/g, 'href="#$1"');
}
