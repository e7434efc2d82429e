// Snippets where a statement of the top level begins, and nowhere else: contributed snippets would be offered everywhere.
'use strict';

const vscode = require('vscode');
const templates = require('../snippets/scene.json');

/** The text without comments and strings, roughly: enough to count brackets. */
function withoutText(text) {
  return text.replace(/"(?:[^"\\\n]|\\.)*"|\/\/.*|\/\*[^]*?(?:\*\/|$)/g, '');
}

function isStatementOfTopLevel(document, position) {
  const line = document.lineAt(position).text.slice(0, position.character);
  if (!/^\s*\w*$/.test(line)) return false;
  const before = withoutText(document.getText(new vscode.Range(0, 0, position.line, 0)));
  return (before.match(/[{[(]/g) ?? []).length === (before.match(/[}\])]/g) ?? []).length;
}

function makeItem(title, { prefix, description, body }) {
  const item = new vscode.CompletionItem({ label: prefix, description: title }, vscode.CompletionItemKind.Snippet);
  item.insertText = new vscode.SnippetString([body].flat().join('\n'));
  item.documentation = description;
  item.sortText = `~${prefix}`; // after the names of the server
  return item;
}

const provider = {
  provideCompletionItems(document, position) {
    if (!isStatementOfTopLevel(document, position)) return [];
    return Object.entries(templates).map(([title, template]) => makeItem(title, template));
  },
};

function registerSnippets() {
  return vscode.languages.registerCompletionItemProvider({ language: 'scene' }, provider);
}

module.exports = { registerSnippets };
