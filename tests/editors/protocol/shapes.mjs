// Compares recorded messages with the types of vscode-languageserver-protocol, by the compiler of TypeScript: each
// message is a literal of the type of its method, so that a missing, mistyped or unknown property is an error.
import { mkdtempSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const modules = process.env.SDLC_NODE_MODULES;
const require = createRequire(join(modules, 'any.js'));
const ts = require('typescript');

const HEADER = `import * as protocol from 'vscode-languageserver-protocol';
type Json<T> = T extends void ? null : T;
type Result<T> = T extends protocol.RequestType0<infer R, any> ? Json<R> : T extends protocol.RequestType<any, infer R, any> ? Json<R> : 'no result';
type Params<T> = T extends protocol.RequestType<infer P, any, any> ? P : T extends protocol.RequestType0<any, any> ? undefined : 'no request';
type NotificationParams<T> = T extends protocol.NotificationType<infer P> ? P : 'no notification';
`;

/** The mistakes in the messages, as texts. */
export function mistakes(recorded) {
  const folder = mkdtempSync(join(tmpdir(), 'sdlc-shapes-'));
  try {
    symlinkSync(modules, join(folder, 'node_modules'));
    const file = join(folder, 'messages.ts');
    // A line for each message: its number is that of the message.
    const lines = recorded.map(({ type, value }, i) => `export const m${i}: ${type} = ${JSON.stringify(value) ?? 'undefined'};`);
    writeFileSync(file, HEADER + lines.join('\n') + '\n');
    const program = ts.createProgram([file], {
      strict: true,
      noEmit: true,
      skipLibCheck: true,
      target: ts.ScriptTarget.ES2022,
      module: ts.ModuleKind.ESNext,
      moduleResolution: ts.ModuleResolutionKind.Bundler,
      types: [],
    });
    const first = HEADER.split('\n').length - 1;
    return ts.getPreEmitDiagnostics(program).map((diagnostic) => {
      const message = ts.flattenDiagnosticMessageText(diagnostic.messageText, '\n  ');
      if (diagnostic.file?.fileName !== file) return message;
      const { line } = diagnostic.file.getLineAndCharacterOfPosition(diagnostic.start);
      const { method, value } = recorded[line - first] ?? {};
      return `${method}: ${message}\n  in ${JSON.stringify(value)?.slice(0, 400)}`;
    });
  } finally {
    rmSync(folder, { recursive: true });
  }
}
