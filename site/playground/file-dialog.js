// The dialog that adds, renames and deletes files.
import { isScene } from './language.js';
import { areMixed, isName } from './link.js';
import { $ } from './page.js';

/**
 * `names()` are those of all files, `current()` that in the editor, and `main()` that which is rendered. `apply({isNew,
 * name, isMain})` gets a valid name; `remove()` deletes the current file.
 */
export class FileDialog {
  #project;
  #isNew;

  constructor({ apply, remove, ...project }) {
    this.#project = project;
    $('file-dialog').addEventListener('submit', (event) => {
      if (event.submitter?.value === 'cancel') return;
      const name = $('file-name').value.trim();
      const fault = this.#faultOf(name);
      $('file-fault').textContent = fault;
      if (fault) return event.preventDefault();
      apply({ isNew: this.#isNew, name, isMain: $('file-is-main').checked });
    });
    $('file-delete').addEventListener('click', () => {
      $('file-dialog').close();
      remove();
    });
  }

  open(isNew) {
    const name = this.#project.current();
    const isMain = !isNew && name === this.#project.main();
    this.#isNew = isNew;
    $('file-title').textContent = isNew ? 'New file' : `File ${name}`;
    $('file-name').value = isNew ? '' : name;
    $('file-is-main').checked = isMain;
    $('file-is-main').disabled = isMain;
    $('file-delete').hidden = isNew || isMain;
    $('file-fault').textContent = '';
    $('file-dialog').showModal();
  }

  #faultOf(name) {
    const others = this.#project.names().filter((each) => this.#isNew || each !== this.#project.current());
    if (!isName(name)) return 'A name has letters, digits and the characters - _ . and / between folders.';
    if (others.includes(name)) return 'A file with this name exists.';
    if (areMixed([name, ...others])) return 'A file and a folder cannot have the same name.';
    if (!isScene(name) && $('file-is-main').checked) return 'Only a .scene file can be rendered.';
    return '';
  }
}
