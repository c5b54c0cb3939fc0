// SPDX-License-Identifier: BSD-3-Clause
// Validates a glTF file: prints the report as JSON, exit code 1 if it has errors.
const fs = require('fs');
const validator = require('gltf-validator');

validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then((report) => {
  console.log(JSON.stringify(report));
  process.exit(report.issues.numErrors === 0 ? 0 : 1);
});
