'use strict';

const vscode = require('vscode');

/** Where scenes are: on the disk, or where the folders of the workspace are. */
function schemes() {
  const folders = vscode.workspace.workspaceFolders ?? [];
  return [...new Set(['file', ...folders.map(({ uri }) => uri.scheme)])];
}

/** The documents that sdlc is asked about: scenes, and the JSON files that the setting `sdlc.configs` names. */
function selector() {
  const patterns = vscode.workspace.getConfiguration('sdlc').get('configs');
  return [
    { scheme: 'untitled', language: 'scene' },
    ...schemes().flatMap((scheme) => [
      { scheme, language: 'scene' },
      ...patterns.map((pattern) => ({ scheme, language: 'json', pattern })),
    ]),
  ];
}

module.exports = { selector };
