// What the extension registers, with a program and in a browser.
'use strict';

const vscode = require('vscode');
const { registerCommands } = require('./commands');
const { SCHEME: EXPLAIN } = require('./explain');
const { VIEW_TYPE } = require('./preview');
const { ConfigSchema, SCHEME: SCHEMA } = require('./schema');
const { registerSnippets } = require('./snippets');

/** `settings` are those that need a restart; `commands`: more of them, by their names. */
async function activate(context, { server, pages, previews, settings, commands }) {
  const schema = new ConfigSchema(server, context.extensionUri);
  const restartIfNeeded = () => server.isNeeded && server.restart();
  context.subscriptions.push(
    vscode.workspace.registerTextDocumentContentProvider(EXPLAIN, pages),
    vscode.workspace.registerTextDocumentContentProvider(SCHEMA, schema),
    ...registerCommands(server, pages, previews, commands),
    registerSnippets(),
    vscode.workspace.onDidOpenTextDocument((document) => server.need(document)),
    vscode.window.onDidChangeTextEditorSelection((change) => previews.follow(change)),
    vscode.window.registerWebviewPanelSerializer(VIEW_TYPE, previews),
    vscode.workspace.onDidRenameFiles((change) => previews.rename(change)),
    vscode.workspace.onDidGrantWorkspaceTrust(restartIfNeeded),
    vscode.workspace.onDidChangeConfiguration((change) => {
      if (settings.some((setting) => change.affectsConfiguration(setting))) restartIfNeeded();
    }),
  );
  for (const document of vscode.workspace.textDocuments) await server.need(document);
}

module.exports = { activate };
