// The pages of `sdlc explain`, shown as Markdown.
'use strict';

const vscode = require('vscode');

/** The scheme of the pages: `sdlc-explain:/E104.md`. */
const SCHEME = 'sdlc-explain';

/** The page without links to files of the repository; those to other pages remain. */
function withoutFileLinks(page) {
  return page.replace(/\[([^\]]+)\]\((?!https?:|[EWS]\d{3}\.md)[^)]*\)/g, '$1');
}

/** A content provider. `server.explanations()` is the output of `sdlc explain --format json`. */
class ExplainPages {
  constructor(server) {
    this.server = server;
    this.text = undefined;
    this.pages = undefined;
  }

  /** Code → { code, name, severity, page }. */
  async all() {
    const text = await this.server.explanations();
    if (this.text !== text) this.pages = new Map(JSON.parse(text).map((page) => [page.code, page]));
    this.text = text;
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
