// SPDX-License-Identifier: GPL-3.0-or-later
// What an editor with yaml-language-server makes of a pipeline, given the schema of the program:
// errors on the right lines, the parameters of the chosen model, what they mean.
//   editor.js SERVER SCHEMA
'use strict';
const { spawn } = require('child_process');
const { pathToFileURL } = require('url');

const [server, schema] = process.argv.slice(2);
const child = spawn(process.execPath, [server, '--stdio'], { stdio: ['pipe', 'pipe', 'inherit'] });
const waiting = new Map(); // answers by id, diagnostics by file
let buffer = Buffer.alloc(0), last = 0, failed = 0;

function send(message) {
    const text = JSON.stringify({ jsonrpc: '2.0', ...message });
    child.stdin.write(`Content-Length: ${Buffer.byteLength(text)}\r\n\r\n${text}`);
}
function ask(method, params) {
    return new Promise((resolve) => {
        waiting.set(++last, resolve);
        send({ id: last, method, params });
    });
}
function receive(message) {
    if (message.method === 'workspace/configuration')
        send({ id: message.id, result: message.params.items.map(({ section }) =>
            section === 'yaml' ? { validate: true, hover: true, completion: true, schemaStore: { enable: false } } : null) });
    else if (message.method && message.id !== undefined)
        send({ id: message.id, result: null });
    else if (message.method === 'textDocument/publishDiagnostics')
        waiting.get(message.params.uri)?.(message.params.diagnostics);
    else if (waiting.has(message.id))
        waiting.get(message.id)(message.result);
}
child.stdout.on('data', (data) => {
    buffer = Buffer.concat([buffer, data]);
    for (;;) {
        const end = buffer.indexOf('\r\n\r\n');
        const length = end < 0 ? NaN : Number(/Content-Length: (\d+)/i.exec(buffer.toString('latin1', 0, end))[1]);
        if (!(buffer.length >= end + 4 + length))
            return;
        const text = buffer.toString('utf8', end + 4, end + 4 + length);
        buffer = buffer.subarray(end + 4 + length);
        receive(JSON.parse(text));
    }
});
child.on('exit', (code) => { console.log(`the server ended with code ${code}`); process.exit(1); });

function check(name, good, seen) {
    console.log(`${good ? 'ok' : 'not ok'} - ${name}`);
    if (!good) {
        failed++;
        console.log(JSON.stringify(seen, null, 1));
    }
}

// Opens a text as a file; where "|" stands in it is the place that is asked about.
let files = 0;
function open(text) {
    const uri = pathToFileURL(`/tmp/flankfilm-${++files}.yaml`).href;
    const whole = `# yaml-language-server: $schema=${pathToFileURL(schema).href}\n${text}`;
    const at = whole.indexOf('|'), before = whole.slice(0, at).split('\n');
    const diagnostics = new Promise((resolve) => waiting.set(uri, resolve));
    send({ method: 'textDocument/didOpen', params: { textDocument: { uri, languageId: 'yaml', version: 1, text: whole.replace('|', '') } } });
    const place = { textDocument: { uri }, position: { line: before.length - 1, character: before.at(-1).length } };
    return { diagnostics, place };
}
async function complete(text) {
    const { diagnostics, place } = open(text);
    await diagnostics;
    const list = await ask('textDocument/completion', place);
    return (list?.items ?? list ?? []).map((item) => item.label);
}
async function hover(text) {
    const { diagnostics, place } = open(text);
    await diagnostics;
    const answer = await ask('textDocument/hover', place);
    return JSON.stringify(answer?.contents ?? '').replace(/\\/g, '');
}
const has = (list, ...words) => words.every((word) => list.includes(word));

async function main() {
    await ask('initialize', { processId: process.pid, rootUri: null, capabilities: {
        workspace: { configuration: true }, textDocument: { hover: { contentFormat: ['markdown'] }, completion: { completionItem: { snippetSupport: true } } } } });
    send({ method: 'initialized', params: {} });
    send({ method: 'workspace/didChangeConfiguration', params: { settings: {} } });

    const pipeline = 'format: 2\npipeline:\n';
    const law = '  viscosity: {use: viscosity/barus, eta0: 5 mPa s, alpha: 11 1/GPa}\n';
    let seen = await open(`${pipeline}${law}outputs: [viscosity.*]\n|`).diagnostics;
    check('a right file has no findings', seen.length === 0, seen);

    seen = await open(`${pipeline}${law}  rho:\n    use: density/tait\n    rho0: 918 kg/m3\n    K_0: 1 GPa\n|`).diagnostics;
    check('a wrong key is found on its line', seen.length === 1 && seen[0].range.start.line === 7 && /K_0/.test(seen[0].message), seen);
    seen = await open(`${pipeline}  oil:\n    use: viscosity/barus\n    eta0: 5\n    alpha: 11 1/GPa\n|`).diagnostics;
    check('a number without its unit is found on its line', seen.length === 1 && seen[0].range.start.line === 5, seen);
    seen = await open(`${pipeline}  viscosity: {use: viscosity/brus}\n|`).diagnostics;
    check('a model that is none is found', seen.length === 1 && seen[0].range.start.line === 3, seen);
    seen = await open(`${pipeline}  mesh: {use: stiffness/iso-6336, shape: round}\nx-own: {any: thing}\n|`).diagnostics;
    check('a word that is no choice is found, a key of the user\'s own is not', seen.length === 1 && seen[0].range.start.line === 3, seen);
    seen = await open('format: 2\npipelin:\n|').diagnostics;
    check('the top of a file is looked at', seen.some((d) => d.range.start.line === 1) && seen.some((d) => d.range.start.line === 2), seen);

    seen = await complete(`${pipeline}  oil:\n    use: viscosity/barus\n    |`);
    check('completion offers the parameters of the chosen model', has(seen, 'eta0', 'alpha', 'with') && !has(seen, 'z') && !has(seen, 'cells'), seen);
    seen = await complete(`${pipeline}  film:\n    use: ehl/finite-volume\n    |`);
    check('and its wires', has(seen, 'cells', 'contact', 'viscosity') && !has(seen, 'alpha'), seen);
    seen = await complete(`${pipeline}  oil:\n    use: |\n`);
    check('completion offers the models', has(seen, 'viscosity/barus', 'ehl/finite-volume'), seen);
    seen = await complete(`${pipeline}  mesh:\n    use: stiffness/iso-6336\n    shape: |\n`);
    check('completion offers choices', has(seen, 'rectangular', 'trapezoidal'), seen);
    seen = await complete(`${pipeline}  oil:\n    use: viscosity/roelands\n    with:\n      viscosity/barus:\n        |`);
    check('completion knows sets under "with"', has(seen, 'alpha') && !has(seen, 'z'), seen);

    seen = await hover(`${pipeline}  oil:\n    use: viscosity/barus\n    al|pha: 11 1/GPa\n`);
    check('hover says what a parameter is, and its unit', /pressure-viscosity coefficient/.test(seen) && /1\/GPa/.test(seen), seen);
    seen = await hover(`${pipeline}  mesh:\n    us|e: stiffness/iso-6336\n`);
    check('hover says what "use" is', /the model/.test(seen), seen);

    console.log(failed ? `${failed} failed` : 'all passed');
    process.exit(failed ? 1 : 0);
}
setTimeout(() => { console.log('the server did not answer in time'); process.exit(1); }, 60000).unref();
main();
