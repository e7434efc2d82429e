// The problems of all files: their list below the text, their marks in it, and their fixes.
import { setDiagnostics } from '@codemirror/lint';
import { $, announce, element } from './page.js';

const severities = ['', 'error', 'warning', 'info', 'hint']; // by their numbers

/** The offset of a place whose `line` and `column` count from 1, the latter in characters. */
export function offsetOf(doc, { line, column }) {
  const { from, text } = doc.line(Math.min(line, doc.lines));
  return from + [...text].slice(0, column - 1).join('').length;
}

const kHasFix = ([, finding]) => finding.fixes.length > 0;

/** `project` has names(), doc(name), current(), view() and goTo(name, from, to). */
export class Problems {
  #project;
  #status = 'Loading…';
  #checked = new Map(); // lists of findings of the language server by name of the file
  #ofScene = []; // [name, finding]: errors of the scene as a whole, such as a missing camera

  constructor(project) {
    this.#project = project;
    $('problems').addEventListener('keydown', ({ key }) => {
      if (key === 'Escape') project.view().focus();
    });
  }

  /** Words in place of the number of problems, or null. While it is 'Checking…', the list is that before. */
  get status() {
    return this.#status;
  }
  set status(status) {
    this.#status = status;
    this.show();
  }

  clear() {
    this.#checked.clear();
    this.#ofScene = [];
  }

  /** Those of Language. */
  take(name, findings) {
    this.#checked.set(name, findings);
    this.show();
  }

  /** Those of the message `scene`. The language server has found most of them, too. */
  takeOfScene(findings) {
    const errors = findings.filter(({ severity, place }) => severity === 'error' && place);
    this.#ofScene = this.#withoutKnown(
      errors.map(({ code, message, help, place }) => [
        place.path,
        {
          code,
          message: [message, ...help].join('\n'),
          range: { start: { line: place.line - 1, character: place.column - 1 } },
          at: () => Array(2).fill(offsetOf(this.#project.doc(place.path), place)),
          fixes: [],
        },
      ]),
    );
    this.show();
  }

  #withoutKnown(findings) {
    return findings.filter(([name, { code }]) => !this.#checked.get(name)?.some((known) => known.code === code));
  }

  /** [name, finding] of all files. */
  #all() {
    const checked = [...this.#checked].flatMap(([name, list]) => list.map((finding) => [name, finding]));
    const names = new Set(this.#project.names());
    return [...checked, ...this.#withoutKnown(this.#ofScene)].filter(([name]) => names.has(name));
  }

  show() {
    const all = this.#all();
    const view = this.#project.view();
    const marks = (this.#checked.get(this.#project.current()) ?? []).map((finding) => {
      const [from, to] = finding.at();
      const actions = finding.fixes.map(({ title, apply }) => ({ name: title, apply }));
      return { from, to, severity: severities[finding.severity ?? 1], message: finding.message, actions };
    });
    view.dispatch(setDiagnostics(view.state, marks));
    const title = this.#status ?? `${all.length || 'No'} problem${all.length === 1 ? '' : 's'}`;
    if ($('problems-title').textContent !== title) announce(title);
    $('problems-title').textContent = title;
    const list = $('problem-list');
    list.classList.toggle('is-old', this.#status !== null);
    const focused = [...list.querySelectorAll('button')].indexOf(document.activeElement);
    list.replaceChildren(...all.map(([name, finding]) => this.#item(name, finding)));
    if (focused >= 0) (list.querySelectorAll('button')[focused] ?? view).focus();
  }

  #item(name, finding) {
    const item = element('li', '', { className: severities[finding.severity ?? 1] });
    const place = `${name}:${finding.range.start.line + 1}:${finding.range.start.character + 1}`;
    const button = element('button', `${finding.code ? `${finding.code}: ` : ''}${finding.message} `, {
      type: 'button',
      className: 'finding',
      onclick: () => this.#project.goTo(name, ...finding.at()),
    });
    button.append(element('span', place));
    item.append(button);
    if (finding.fixes.length > 0) item.append(this.#fixes(finding));
    return item;
  }

  #fixes({ fixes }) {
    const buttons = fixes.map(({ title, apply }) => {
      const onclick = () => {
        apply();
        this.#project.view().focus();
      };
      return element('button', title, { type: 'button', onclick });
    });
    const all = element('div', '', { className: 'fixes' });
    all.append(...buttons);
    return all;
  }

  /** To the first fix of the problem at the cursor, or of the next one; a command of the editor. */
  focusFix() {
    const current = this.#project.current();
    const { head } = this.#project.view().state.selection.main;
    const all = this.#all();
    const isAhead = ([name, finding]) => name === current && finding.at()[1] >= head;
    const ahead = all.findIndex((each) => kHasFix(each) && isAhead(each));
    const index = ahead >= 0 ? ahead : all.findIndex(kHasFix);
    $('problem-list').children[index]?.querySelector('.fixes button').focus();
    if (index < 0) announce('No problem has a fix');
    return true;
  }
}
