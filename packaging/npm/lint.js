#!/usr/bin/env node
const args = process.argv.slice(2);
require("./run.js")(args[0] === "--version" ? args : ["lint", ...args]);
