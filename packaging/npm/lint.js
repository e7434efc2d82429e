#!/usr/bin/env node
require("./run.js")(["lint", ...process.argv.slice(2)]);
