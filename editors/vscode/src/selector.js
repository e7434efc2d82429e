'use strict';

/** The documents that sdlc is asked about. The server itself leaves JSON files alone that are no configs. */
const SELECTOR = [
  { scheme: 'file', language: 'scene' },
  { scheme: 'untitled', language: 'scene' },
  { scheme: 'file', language: 'json' },
];

module.exports = { SELECTOR };
