// Elements of the page, and what is said to everybody.

export const $ = (id) => document.getElementById(id);

/** Calls `action` once, `ms` after the last call. */
export function later(ms, action) {
  let timer;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(action, ms);
  };
}

export function element(tag, text, properties = {}) {
  return Object.assign(document.createElement(tag), { textContent: text, ...properties });
}

let noticeStays;
/** A sentence for everybody, with a button if there is an action: [label, function]. `stays`: at the next change of the
 * text. */
export function notify(text, action, stays = Boolean(action)) {
  noticeStays = stays;
  $('notice').textContent = text;
  $('notice-box').hidden = text === '';
  $('notice-action').hidden = !action;
  if (text) announce(text);
  if (!action) return;
  $('notice-action').textContent = action[0];
  $('notice-action').onclick = () => {
    notify('');
    action[1]();
  };
}
export function announce(text) {
  $('announcement').textContent = text;
}

/** Removes a notice that does not stay. */
export function endNotice() {
  if (!noticeStays) notify('');
}
