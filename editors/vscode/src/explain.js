// The pages of `sdlc explain`, shown as Markdown.
'use strict';

const vscode = require('vscode');
const { run } = require('./program');

/** The scheme of the pages: `sdlc-explain:/E104.md`. */
const SCHEME = 'sdlc-explain';

const NO_SERVER = 'sdlc is missing, see its log';

/** The page without links to files of the repository; those to other pages remain. */
function withoutFileLinks(page) {
  return page.replace(/\[([^\]]+)\]\((?!https?:|[EWS]\d{3}\.md)[^)]*\)/g, '$1');
}

/** A content provider. The pages come from the program, one call for all of them, once per program. */
class ExplainPages {
  constructor(server) {
    this.server = server;
    this.program = undefined;
    this.pages = undefined;
  }

  /** Code → { code, name, severity, page }. */
  async all() {
    const { program } = this.server;
    if (!program) throw new Error(NO_SERVER);
    if (this.program !== program) {
      const pages = JSON.parse(await run(program, ['explain', '--format', 'json']));
      this.pages = new Map(pages.map((page) => [page.code, page]));
      this.program = program;
    }
    return this.pages;
  }

  async provideTextDocumentContent(uri) {
    const code = /([EWS]\d{3})\.md$/.exec(uri.path)?.[1];
    const found = (await this.all()).get(code);
    return found ? withoutFileLinks(found.page) : `\`${uri.path}\` is not a page of \`sdlc explain\`.`;
  }

  async show(code) {
    const uri = vscode.Uri.from({ scheme: SCHEME, path: `/${code}.md` });
    await vscode.commands.executeCommand('markdown.showPreview', uri);
  }
}

module.exports = { ExplainPages, SCHEME };
