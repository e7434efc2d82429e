// The commands of the palette. Those of the server, such as `sdlc.render`, are registered by the
// language client under their own names; these find out what they are applied to.
'use strict';

const vscode = require('vscode');
const { selector } = require('./selector');

/** Why a command cannot do anything. */
class Refusal extends Error {}

function activeDocument(uri) {
  const documents = vscode.workspace.textDocuments;
  const named = uri && documents.find((document) => document.uri.toString() === uri.toString());
  const document = named ?? vscode.window.activeTextEditor?.document;
  if (document) return document;
  throw new Refusal('Open a scene first.');
}

/** Shows the scene beside the editor, as it is there. */
async function preview(previews, uri) {
  const document = activeDocument(uri);
  if (document.isUntitled) throw new Refusal('Save the scene first: its imports are relative to its folder.');
  await previews.open(document.uri);
  if (vscode.languages.match(selector(), document) > 0) return;
  vscode.window.showInformationMessage(
    'The preview shows this file as it is saved. It follows what you type if the setting sdlc.configs names it.');
}

/** The codes of the findings of the active file, those of the cursor's line first. */
function codesInFile() {
  const editor = vscode.window.activeTextEditor;
  if (!editor) return [];
  const line = editor.selection.active.line;
  const distance = ({ range }) => Math.abs(range.start.line - line);
  const found = [...vscode.languages.getDiagnostics(editor.document.uri)]
    .filter(({ source }) => source === 'sdlc')
    .sort((a, b) => distance(a) - distance(b));
  return [...new Set(found.map(({ code }) => code?.value ?? code))];
}

async function chooseCode(pages) {
  const all = await pages.all();
  const here = codesInFile().filter((code) => all.has(code));
  const item = (code) => ({ label: code, description: all.get(code).name.replaceAll('_', ' ') });
  const separator = (label) => ({ label, kind: vscode.QuickPickItemKind.Separator });
  const others = [...all.keys()].filter((code) => !here.includes(code));
  const items = [...here.map(item), separator('all'), ...others.map(item)];
  if (here.length > 0) items.unshift(separator('in this file'));
  const options = { placeHolder: 'Which diagnostic?', matchOnDescription: true };
  return (await vscode.window.showQuickPick(items, options))?.label;
}

async function explain(pages, code) {
  const chosen = typeof code === 'string' ? code : await chooseCode(pages);
  if (chosen) await pages.show(chosen);
}

/** Registers the commands; each shows the reason when it fails. `more`: those about a document, by their names. */
function registerCommands(server, pages, previews, more) {
  const commands = {
    'sdlc.previewScene': (uri) => preview(previews, uri),
    'sdlc.explainCode': (code) => explain(pages, code),
    'sdlc.checkFileIn': (uri) => server.ask('sdlc.chooseScene', activeDocument(uri).uri),
    'sdlc.fixAllInFile': (uri) => server.ask('sdlc.fixAll', activeDocument(uri).uri),
    'sdlc.restartServer': () => server.restart(),
    'sdlc.showLog': () => server.log.show(),
  };
  for (const [name, command] of Object.entries(more)) commands[name] = (uri) => command(activeDocument(uri));
  return Object.entries(commands).map(([name, command]) =>
    vscode.commands.registerCommand(name, async (...args) => {
      try {
        return await command(...args);
      } catch (error) {
        if (!(error instanceof Refusal)) server.log.error(`${name}: ${error.message}`);
        vscode.window.showErrorMessage(error.message);
      }
    }),
  );
}

module.exports = { Refusal, registerCommands };
