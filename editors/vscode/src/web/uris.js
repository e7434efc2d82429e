// Names of files in the engine: `vscode-vfs/github/owner/project/ball.scene`. So it can have files of several systems,
// and imports lead from one to another as they do there.
'use strict';

const vscode = require('vscode');

const FOLDER = '/~sdlc~/'; // of all of them, in the engine; no text has it

function nameOf({ scheme, authority, path }) {
  return `${scheme}/${authority || '-'}${path}`;
}

function uriOf(name) {
  const [scheme, authority, ...path] = name.split('/');
  return vscode.Uri.from({ scheme, authority: authority === '-' ? '' : authority, path: `/${path.join('/')}` });
}

/** The URIs of the language server. */
const converters = {
  code2Protocol(uri) {
    if (uri.scheme === 'untitled') return uri.toString();
    return vscode.Uri.from({ scheme: 'file', path: FOLDER + nameOf(uri) }).toString();
  },
  protocol2Code(text) {
    const uri = vscode.Uri.parse(text);
    return uri.scheme === 'file' && uri.path.startsWith(FOLDER) ? uriOf(uri.path.slice(FOLDER.length)) : uri;
  },
};

/** A message of the server whose texts have paths as they are in VS Code: `/owner/project/ball.scene`. */
function withPlainPaths(message) {
  return JSON.parse(JSON.stringify(message).replace(/(?<!file:\/\/)\/~sdlc~\/[^/"]+\/[^/"]+(?=\/)/g, ''));
}

module.exports = { FOLDER, converters, nameOf, uriOf, withPlainPaths };
