// validate_glb.js FILE...: Khronos' validator on each; exit 1 when one has an error or a warning, 77 when the validator
// is not installed (tools/setup --test).
const fs = require('fs');

let validator;
try {
    validator = require('gltf-validator');
} catch {
    console.log('gltf-validator is not installed (tools/setup --test)');
    process.exit(77);
}

async function problems(file) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
    const issues = report.issues;
    console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
    for (const message of issues.messages) console.log(`  ${message.code} at ${message.pointer}: ${message.message}`);
    return issues.numErrors + issues.numWarnings;
}

(async () => {
    let count = 0;
    for (const file of process.argv.slice(2)) count += await problems(file);
    process.exit(count > 0 ? 1 : 0);
})();
