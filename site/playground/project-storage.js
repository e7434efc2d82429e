// What is kept of the project: in the storage of the tab and of the browser, and in the address.
import { isProject, kMaxLink, toFragment } from './link.js';
import { later, notify } from './page.js';

const kProject = 'sdlc-playground';
const kPrevious = 'sdlc-playground-before'; // the project before this one

function store(storage, key, value) {
  try {
    globalThis[storage].setItem(key, JSON.stringify(value));
    return true;
  } catch {
    return false; // there is no room, or the browser keeps nothing
  }
}
function stored(storage, key) {
  try {
    const value = JSON.parse(globalThis[storage].getItem(key));
    return isProject(value) ? value : null;
  } catch {
    return null;
  }
}

// Stored projects, or null. Those of the tab and of the browser have `fragment` and `isOwn`, too.
export const storedOfTab = () => stored('sessionStorage', kProject);
export const storedOfBrowser = () => stored('localStorage', kProject);
export const storedPrevious = () => stored('localStorage', kPrevious);
/** False if it has no room. */
export const storePrevious = (project) => store('localStorage', kPrevious, project);

export class ProjectStorage {
  /** Whether the text exists only here; false for an unchanged example. */
  isOwn = false;
  #snapshot;
  #lastSave; // the promise of the last save()
  #fragment = ''; // of the text that was stored last; empty if it is too long
  #isDirty = false; // whether anything has changed since it was stored
  #hasWarned = false; // that the text is lost when the page is left
  #saveLater = later(400, () => this.save());

  /** `snapshot()` is the project. */
  constructor(snapshot) {
    this.#snapshot = snapshot;
    addEventListener('pagehide', () => this.#isDirty && this.store());
  }

  /** False if the browser does not keep it. */
  store() {
    this.#isDirty = false;
    const now = { ...this.#snapshot(), fragment: this.#fragment, isOwn: this.isOwn };
    store('sessionStorage', kProject, now);
    return store('localStorage', kProject, now);
  }

  /** Puts the project into the storage and the address. Returns the address, or null if it is too long. */
  save() {
    const { href } = location;
    const save = toFragment(this.#snapshot()).then((made) => {
      if (save !== this.#lastSave) return this.#lastSave; // it has a later text
      const isTooLong = made.length > kMaxLink;
      this.#fragment = isTooLong ? '' : made;
      const isLost = !this.store() && isTooLong;
      if (isLost && !this.#hasWarned) notify('This browser does not keep the text, which is too long for a link: copy it.', null, true);
      this.#hasWarned = isLost;
      const address = new URL(isTooLong ? location.pathname : `#${this.#fragment}`, href).href;
      // The user may have gone to another entry of the history: its address stays.
      if (location.href === href) history.replaceState(null, '', address);
      return isTooLong ? null : address;
    });
    this.#lastSave = save;
    return save;
  }

  saveSoon() {
    this.#isDirty = true;
    this.#saveLater();
  }

  /** At the user's request: says what was kept. */
  saveByUser() {
    const isKept = this.store();
    this.save();
    notify(isKept ? 'The text is kept in this browser.' : 'This browser keeps nothing: copy the link or the text.');
    return true;
  }

  async copyLink() {
    const link = await this.save();
    if (!link) {
      const length = (await toFragment(this.#snapshot())).length.toLocaleString('en');
      return notify(`The link would have ${length} characters, more than many programs pass on. The text is kept in this
        browser; to share it, send its files. Data files take most of a link: smaller ones help.`);
    }
    try {
      await navigator.clipboard.writeText(link);
      notify('The link is copied. It has the text, the settings and the choices.');
    } catch {
      notify('The browser refuses to copy. The address of this page is the link.');
    }
  }
}
