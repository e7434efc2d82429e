'use strict';

const vscode = require('vscode');

/** The documents that sdlc is asked about: scenes, and the JSON files that the setting `sdlc.configs` names. */
function selector() {
  const scenes = ['file', 'untitled'].map((scheme) => ({ scheme, language: 'scene' }));
  const patterns = vscode.workspace.getConfiguration('sdlc').get('configs');
  return [...scenes, ...patterns.map((pattern) => ({ scheme: 'file', language: 'json', pattern }))];
}

module.exports = { selector };
