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

/** The place of an offset, or that of the end if the text is shorter. */
export function placeOf(doc, offset) {
  const { number, from, text } = doc.lineAt(Math.min(offset, doc.length));
  return { line: number, column: [...text.slice(0, offset - from)].length + 1 };
}

const hasFix = ([, finding]) => finding.fixes.length > 0;

/** `project` has names(), doc(name), current(), view() and goTo(name, from, to). */
export class Problems {
  #project;
  #status = $('problems-title').textContent;
  #checked = new Map(); // lists of findings of the language server by name of the file
  #ofScene = []; // [name, finding]: errors of the scene as a whole, such as a missing camera
  #listed = []; // [name, finding] of each row of the list

  constructor(project) {
    this.#project = project;
    $('problems').addEventListener('keydown', ({ key }) => {
      if (key === 'Escape') project.view().focus();
    });
    $('problem-list').addEventListener('click', ({ target }) => this.#click(target.closest('button')));
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
      const [from, to] = finding.at().map((offset) => Math.min(offset, view.state.doc.length));
      const actions = finding.fixes.map(({ title, apply }) => ({ name: title, apply }));
      return { from, to, severity: severities[finding.severity ?? 1], message: finding.message, actions };
    });
    view.dispatch(setDiagnostics(view.state, marks));
    const title = this.#status ?? `${all.length || 'No'} problem${all.length === 1 ? '' : 's'}`;
    if ($('problems-title').textContent !== title) announce(title);
    $('problems-title').textContent = title;
    const list = $('problem-list');
    list.classList.toggle('is-old', this.#status !== null);
    const focused = document.activeElement.closest('#problem-list li');
    const index = [...list.children].indexOf(focused);
    this.#showRows(all.map(([name, finding]) => this.#row(name, finding)));
    this.#listed = all;
    if (focused && !list.contains(document.activeElement)) {
      // Not to a fix: Enter would apply one that the user has not chosen.
      const row = list.contains(focused) ? focused : (list.children[index] ?? list.lastChild);
      (row?.firstChild ?? view).focus();
    }
  }

  /** Rows of the same problem stay: a click on what is replaced between press and release is lost. */
  #showRows(rows) {
    const list = $('problem-list');
    const before = [...list.children];
    const shown = rows.map((row) => {
      const isSame = (other) => other.className === row.className && other.firstChild.isEqualNode(row.firstChild);
      const index = before.findIndex(isSame);
      if (index < 0) return row;
      const [kept] = before.splice(index, 1);
      if (!kept.isEqualNode(row)) {
        kept.querySelector('.fixes')?.remove();
        kept.append(...[...row.children].slice(1));
      }
      return kept;
    });
    for (const row of before) row.remove();
    shown.forEach((row, index) => {
      if (list.children[index] !== row) list.insertBefore(row, list.children[index] ?? null);
    });
  }

  #row(name, finding) {
    const row = element('li', '', { className: severities[finding.severity ?? 1] });
    const button = element('button', `${finding.code ? `${finding.code}: ` : ''}${finding.message} `, {
      type: 'button',
      className: 'finding',
    });
    const { line, column } = placeOf(this.#project.doc(name), finding.at()[0]);
    button.append(element('span', `${name}:${line}:${column}`));
    row.append(button);
    if (finding.fixes.length > 0) {
      const fixes = element('div', '', { className: 'fixes' });
      fixes.append(...finding.fixes.map(({ title }) => element('button', title, { type: 'button' })));
      row.append(fixes);
    }
    return row;
  }

  /** `button`: the finding of a row, or one of its fixes; null beside them. */
  #click(button) {
    if (!button) return;
    const row = button.closest('li');
    const [name, finding] = this.#listed[[...row.parentElement.children].indexOf(row)];
    const fix = finding.fixes[[...row.querySelectorAll('.fixes button')].indexOf(button)];
    if (!fix) return this.#project.goTo(name, ...finding.at());
    button.disabled = true; // a double click applies it once
    fix.apply();
    this.#project.view().focus();
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
