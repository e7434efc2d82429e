// Elements of the page, notices and announcements.

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
/** Shows a notice, and announces it; with a button if there is an action: [label, function]. `stays`: a change of the
 * text does not remove it. */
export function notify(text, action, stays = Boolean(action)) {
  const hadFocus = $('notice-box').contains(document.activeElement);
  noticeStays = stays;
  $('notice').textContent = text;
  $('notice-box').hidden = text === '';
  $('notice-action').hidden = !action;
  if (hadFocus && !text) document.querySelector('.cm-content').focus();
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

// Above the problems, so that their fixes can be reached.
new ResizeObserver(() => {
  $('notice-box').style.bottom = `${$('problems').offsetHeight + 8}px`;
}).observe($('problems'));
