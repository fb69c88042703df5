// SPDX-License-Identifier: MIT
// The part of an address behind #: a demo, such as #jump; a scene of the list, #scene=jump.toml; or
// the text of a scene, #deflated=… or #text=…, in base64url. &setting=rk4@120 may follow.
'use strict';

const longestScene = 65536;  // bytes, as of a file
const settingPattern = /^\w+@\d+$/;

async function piped(bytes, transform) {
  const parts = [];
  let size = 0;
  for await (const part of chunks(new Blob([bytes]).stream().pipeThrough(transform))) {
    size += part.length;
    if (size > longestScene) throw new RangeError('too long');
    parts.push(part);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

async function* chunks(stream) {
  const reader = stream.getReader();
  for (let part; !(part = await reader.read()).done;) yield part.value;
}

function toBase64Url(bytes) {
  return btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(''))
    .replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

function fromBase64Url(text) {
  return Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')),
                         letter => letter.charCodeAt(0));
}

async function linkOfText(text) {
  const bytes = new TextEncoder().encode(text);
  return typeof CompressionStream === 'undefined'
    ? `text=${toBase64Url(bytes)}`
    : `deflated=${toBase64Url(await piped(bytes, new CompressionStream('deflate-raw')))}`;
}

// Returns {name} of a demo, {file} of the list or {text}, each with a setting or undefined.
async function readLink(hash) {
  const parameters = new URLSearchParams(hash.slice(1) || oilerList.demos[0].name);
  const [[key, value]] = parameters;
  const setting = settingPattern.exec(parameters.get('setting') ?? '')?.[0];
  if (key === 'scene') return {file: value, setting};
  if (key !== 'text' && key !== 'deflated') return {name: key, setting};
  const bytes = fromBase64Url(value);
  // The longest scene takes no more, packed or not, and as many bytes unfold to 70 MB at most.
  if (bytes.length > longestScene + 1024) throw new RangeError('too long');
  const plain = key === 'text'
    ? bytes : await piped(bytes, new DecompressionStream('deflate-raw'));
  return {text: new TextDecoder('utf-8', {fatal: true}).decode(plain), setting};
}
