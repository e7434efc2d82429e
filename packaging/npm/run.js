// Runs the program that the package of this platform contains, and ends as it ends.
const os = require("node:os");
const { spawnSync } = require("node:child_process");

module.exports = (args) => {
  const name = `@sdlc/${process.platform}-${process.arch}`;
  let program;
  try {
    program = require.resolve(`${name}/bin/sdlc`);
  } catch {
    console.error(
      `sdlc-lint: the package ${name}, which has the program, is missing: install it too, or ` +
        "npm install --include=optional; there is none for other systems than Linux"
    );
    process.exit(2);
  }
  const result = spawnSync(program, args, { stdio: "inherit" });
  if (result.error) {
    console.error(`sdlc-lint: ${program} cannot run: ${result.error.message}`);
    process.exit(2);
  }
  if (result.signal) process.kill(process.pid, result.signal);
  // Not reached after most signals; as the first process of a container, after all.
  process.exit(result.status ?? 128 + os.constants.signals[result.signal]);
};
