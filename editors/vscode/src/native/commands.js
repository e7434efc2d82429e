// The commands that need the program.
'use strict';

const path = require('node:path');
const vscode = require('vscode');
const { Refusal } = require('../commands');

async function render(server, document) {
  if (document.isUntitled) throw new Refusal('Save the scene first: its picture is named after it.');
  await server.ask('sdlc.render', document.uri);
}

/** Measures in a terminal of its own, whose output remains when the program ends. */
async function measure(server, document) {
  if (document.isUntitled || !(await document.save())) throw new Refusal('Save the scene first.');
  if (!server.program) throw new Refusal('sdlc is missing, see its log.');
  const file = document.uri.fsPath;
  const folder = vscode.workspace.getWorkspaceFolder(document.uri);
  const cwd = folder?.uri.fsPath ?? path.dirname(file);
  const flags = vscode.workspace.isTrusted ? [] : ['--sandbox'];
  const execution = new vscode.ProcessExecution(server.program, ['measure', file, ...flags], { cwd });
  const name = `measure ${path.basename(file)}`;
  const task = new vscode.Task({ type: 'process' }, folder ?? vscode.TaskScope.Workspace, name, 'sdlc', execution);
  task.presentationOptions = { reveal: vscode.TaskRevealKind.Always, clear: true };
  await vscode.tasks.executeTask(task);
}

module.exports = { measure, render };
