// The problems of all files: their list below the text, their marks in it, and their fixes.
import { setDiagnostics } from '@codemirror/lint';
import { withoutFlags } from './language.js';
import { $, announce, element } from './page.js';

const severities = ['', 'error', 'warning', 'info', 'hint']; // by their numbers

/** The offset of a place: `line` and `column` count from 1, columns in characters. */
export function offsetOf(doc, { line, column }) {
  const { from, text } = doc.line(Math.min(line, doc.lines));
  return from + [...text].slice(0, column - 1).join('').length;
}

/** The place of an offset. */
export function placeOf(doc, offset) {
  const { number, from, text } = doc.lineAt(offset);
  return { line: number, column: [...text.slice(0, offset - from)].length + 1 };
}

const hasFix = ([, finding]) => finding.fixes.length > 0;

/** `project` has names(), doc(name), current(), view() and goTo(name, from, to). */
export class Problems {
  #project;
  #status = $('problems-title').textContent;
  #checked = new Map(); // lists of findings of the language server by name of the file
  #ofScene = []; // [name, finding]: errors of the scene as a whole, such as a missing camera

  constructor(project) {
    this.#project = project;
    $('problems').addEventListener('keydown', ({ key }) => {
      if (key === 'Escape') project.view().focus();
    });
  }

  /** Words in place of the number of problems, or null. The list is grey while there is a status. */
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

  /** Takes the findings of the language server for a file. */
  take(name, findings) {
    this.#checked.set(name, findings);
    this.#ofScene = this.#withoutKnown(this.#ofScene);
    this.show();
  }

  /** Takes the findings of the message `scene`. The language server has found most of them, too. */
  takeOfScene(findings) {
    const names = new Set(this.#project.names());
    const errors = findings.filter(({ severity, place }) => severity === 'error' && names.has(place?.path));
    this.#ofScene = this.#withoutKnown(
      errors.map(({ code, message, help, place }) => [
        place.path,
        {
          code,
          message: withoutFlags([message, ...help].join('\n')),
          at: () => Array(2).fill(offsetOf(this.#project.doc(place.path), place)),
          fixes: [],
        },
      ]),
    );
    this.show();
  }

  #withoutKnown(findings) {
    const isSame = (one, other) => one.code === other.code && one.at()[0] === other.at()[0];
    return findings.filter(([name, finding]) => !this.#checked.get(name)?.some((known) => isSame(known, finding)));
  }

  /** All problems as [name of the file, finding]. */
  #all() {
    const checked = [...this.#checked].flatMap(([name, list]) => list.map((finding) => [name, finding]));
    const names = new Set(this.#project.names());
    return [...checked, ...this.#ofScene].filter(([name]) => names.has(name));
  }

  show() {
    const all = this.#all();
    const view = this.#project.view();
    const shown = all.filter(([name]) => name === this.#project.current());
    const marks = shown.map(([, finding]) => {
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
    const button = element('button', `${finding.code ? `${finding.code}: ` : ''}${finding.message} `, {
      type: 'button',
      className: 'finding',
      onclick: () => this.#project.goTo(name, ...finding.at()),
    });
    const { line, column } = placeOf(this.#project.doc(name), finding.at()[0]);
    button.append(element('span', `${name}:${line}:${column}`));
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
    const ahead = all.findIndex((each) => hasFix(each) && isAhead(each));
    const index = ahead >= 0 ? ahead : all.findIndex(hasFix);
    $('problem-list').children[index]?.querySelector('.fixes button').focus();
    if (index < 0) announce('No problem has a fix');
    return true;
  }
}
