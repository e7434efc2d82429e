// What is kept of the project: in the storage of the tab and of the browser, and in the address.
import { isProject, kMaxLink, toFragment } from './link.js';
import { later, notify } from './page.js';

const kProject = 'sdlc-playground';
const kBefore = 'sdlc-playground-before'; // what the project has replaced

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

// Stored projects, or null. They have `fragment`, that of the address, and `isOwn`, too.
export const storedOfTab = () => stored('sessionStorage', kProject);
export const storedOfBrowser = () => stored('localStorage', kProject);
export const storedBefore = () => stored('localStorage', kBefore);
/** False if it has no room. */
export const storeBefore = (project) => store('localStorage', kBefore, project);

export class Keeping {
  /** Whether the text is nowhere else; an example that nobody changed is. */
  isOwn = false;
  #snapshot;
  #making; // the promise of the last keep()
  #fragment = ''; // the last one that was put into the address
  #isDirty = false; // whether anything has changed since it was stored
  #hasWarned = false; // that the text is lost when the page is left
  #keepLater = later(400, () => this.keep());

  /** `snapshot()` is the project. */
  constructor(snapshot) {
    this.#snapshot = snapshot;
    addEventListener('pagehide', () => this.#isDirty && this.storeNow());
  }

  /** False if the browser does not keep it. */
  storeNow() {
    this.#isDirty = false;
    const now = { ...this.#snapshot(), fragment: this.#fragment, isOwn: this.isOwn };
    store('sessionStorage', kProject, now);
    return store('localStorage', kProject, now);
  }

  /** Puts the project into the storage and the address. Returns the address, or null if it is too long. */
  keep() {
    const { href } = location;
    const mine = toFragment(this.#snapshot()).then((made) => {
      if (mine !== this.#making) return this.#making; // it has a later text
      const isTooLong = made.length > kMaxLink;
      this.#fragment = isTooLong ? '' : made;
      const isLost = !this.storeNow() && isTooLong;
      if (isLost && !this.#hasWarned) notify('This browser does not keep the text, which is too long for a link: copy it.', null, true);
      this.#hasWarned = isLost;
      const address = new URL(isTooLong ? location.pathname : `#${this.#fragment}`, href).href;
      // “Back” may have been pressed: that entry of the history keeps its address.
      if (location.href === href) history.replaceState(null, '', address);
      return isTooLong ? null : address;
    });
    this.#making = mine;
    return mine;
  }

  keepSoon() {
    this.#isDirty = true;
    this.#keepLater();
  }

  /** At the user's wish. */
  keepNow() {
    const isKept = this.storeNow();
    this.keep();
    notify(isKept ? 'The text is kept in this browser.' : 'This browser keeps nothing: copy the link or the text.');
    return true;
  }

  async copyLink() {
    const link = await this.keep();
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
