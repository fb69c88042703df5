// SPDX-License-Identifier: MIT
// Plays the program on a canvas, and runs its commands in a worker. A page that is opened as a file
// may neither fetch nor start a worker from a file: there the program is read from scripts.
'use strict';

const oilerModule = compileOiler();
oilerModule.catch(() => {});  // playOiler and runOiler throw it

async function compileOiler() {
  if (typeof WebAssembly === 'undefined')
    throw new Error('This browser has no WebAssembly: allow it, or take another browser.');
  try {
    if (location.protocol === 'file:') {
      await loadScript('wasm.js');
      return await WebAssembly.compile(Uint8Array.from(atob(oilerWasm), c => c.charCodeAt(0)));
    }
    const answer = await fetch('oiler.wasm');
    if (!answer.ok) throw new Error(`oiler.wasm: ${answer.status} ${answer.statusText}`);
    return answer.headers.get('Content-Type') === 'application/wasm'
      ? await WebAssembly.compileStreaming(answer)
      : await WebAssembly.compile(await answer.arrayBuffer());
  } catch (error) {
    throw new Error(error instanceof WebAssembly.CompileError
      ? 'This browser is too old for the program: take one of 2023 or later.'
      : `The program cannot be loaded (${error.message}): reload the page.`);
  }
}

function loadScript(src) {
  return new Promise((resolve, reject) => {
    const onerror = () => reject(new Error(`${src} is missing`));
    document.head.append(
      Object.assign(document.createElement('script'), {src, onload: resolve, onerror}));
  });
}

// `files` has contents by path, or functions of the file system that return them. The worker has
// this function, too.
function oilerOptions(wasm, args, files) {
  const options = {
    arguments: [...args],  // the program puts its own name before them
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(wasm, imports).then(done);
      return {};
    },
    onRuntimeInitialized() {
      for (const [path, content] of Object.entries(files))
        options.FS.writeFile(path, content instanceof Function ? content(options.FS) : content);
    }
  };
  return options;
}

// `hooks` are the functions that the program calls, see engine/oiler/platform/web.cpp.
async function playOiler(canvas, args, files, hooks) {
  const options = oilerOptions(await oilerModule, args, files);
  return oilerProgram()(Object.assign(options, {canvas, print() {}, printErr() {}}, hooks));
}

// Messages of errors begin with the program's name.
const failureIn = (lines, args) => lines.find(line => line.startsWith(`${args[0]}: `)) ?? '';

// Returns {result, cancel}. The result has the lines of both streams and the failure: '' if there is
// none, null if the command was cancelled.
function runOiler(args, files, onLine = () => {}) {
  const lines = {output: [], errors: []};
  const {promise, resolve} = withResolvers();
  let worker = null, isOver = false;
  const end = failure => {
    isOver = true;
    worker?.terminate();
    resolve({...lines, failure});
  };
  const take = (stream, line) => {
    lines[stream].push(line);
    onLine(line);
  };
  oilerModule.then(wasm => {
    if (isOver) return;
    worker = new Worker(workerUrl());
    worker.onmessage = ({data: {stream, line}}) =>
      stream ? take(stream, line) : end(failureIn(lines.errors, args));
    worker.postMessage({wasm, args, files});
  }).catch(error => {
    take('errors', error.message);
    end(error.message);
  });
  return {result: promise, cancel: () => end(null)};
}

function withResolvers() {  // as Promise.withResolvers of 2024
  const parts = {};
  parts.promise = new Promise(resolve => { parts.resolve = resolve; });
  return parts;
}

let workerBlob = null;
function workerUrl() {
  return workerBlob ??= URL.createObjectURL(
    new Blob([oilerOptions, `(${serveCommand})((${oilerProgram})())`], {type: 'text/javascript'}));
}

function serveCommand(createOiler) {
  onmessage = async ({data: {wasm, args, files}}) => {
    const tell = stream => line => postMessage({stream, line});
    try {
      await createOiler(Object.assign(oilerOptions(wasm, args, files),
                                      {print: tell('output'), printErr: tell('errors')}));
    } catch (error) {
      tell('errors')(`${args[0]}: ${error}`);
    }
    postMessage({});
  };
}

// Returns a function that shows a text, at most one a second, so that it can be read.
function slowly(element) {
  let text = '';
  setInterval(() => { if (element.textContent !== text) element.textContent = text; }, 1000);
  return newText => { text = newText; };
}
