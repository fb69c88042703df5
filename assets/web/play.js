// SPDX-License-Identifier: MIT
// The game on the canvas: its keys, setting, link and recordings. Texts of scenes, links, files and
// the program enter the page as text only.
'use strict';

const find = id => document.getElementById(id);
const recordingFile = 'recording';

let game = {};            // {name} of a demo, {file, text} of a listed scene, {text} of another
let playing = null;       // {module, ended, isRecording}; module is null before and after the game
let setting = '';         // such as rk4@120
let usualSetting = null;  // that of the game without a link and without a choice
let wish = null;          // setting that the game takes next
let isTyping = false;     // a rate
let pausesFirst = false;  // whether a new game is paused at its first frame

function complain(reason) {
  find('problem').textContent = reason;
  find('problem').hidden = reason === '';
}
const say = words => { find('said').textContent = words; };
const showLine = slowly(find('line'));

const isScene = () => game.name === undefined;
const scenePath = () => game.file ?? 'scene.toml';
const command = () => isScene() ? ['oiler', 'play', scenePath()] : [game.name];
const sceneFiles = () => isScene() ? {[scenePath()]: find('text').value} : {};
// The text of a scene of the list is in the program.
const firstFiles = () => game.text === undefined && isScene()
  ? {[scenePath()]: FS => FS.readFile(`/scenes/${game.file}`)} : sceneFiles();
const settingOptions = text => {
  const [method, rate] = text.split('@');
  return ['--method', method, '--rate', rate];
};
// A game may refuse its own setting as an option.
const chosenOptions = () => {
  const chosen = wish ?? setting;
  return chosen && chosen !== usualSetting ? settingOptions(chosen) : [];
};

// One game after the other.
let queue = Promise.resolve();
let plays = 0;
function play(options = chosenOptions(), files = {}) {
  ++plays;
  queue = queue.then(end).then(() => start(options, files));
  return queue;
}

async function end() {
  if (!playing?.module) return;
  playing.module.closes = true;
  await playing.ended;
}

async function start(options, files) {
  complain('');
  say('');
  wish = null;  // the options have it
  fixSetting(recordingFile in files || options.includes(recordingFile));
  const canvas = find('canvas').cloneNode();  // a canvas keeps its context, also a lost one
  find('canvas').replaceWith(canvas);
  const remarks = [];
  const {promise, resolve} = withResolvers();
  const shown = playing = {module: null, ended: promise};
  let isLost = false, isOver = false;
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('webglcontextlost', () => { isLost = true; });
  canvas.addEventListener('keydown', ({code}) => { if (isOver && code === 'F9') play(); });
  const onEnd = reason => {
    shown.module = null;
    isOver = true;
    fixSetting(false);
    pausesFirst = isLost && find('pause').ariaPressed === 'true';
    find('pause').ariaPressed = false;
    resolve();
    if (isLost) beginAnew(files[recordingFile] ? options : chosenOptions(), files);
    else if (reason) complain(reason);
    else say(remarks.find(line => line.includes('replay')) ?? 'The game has ended.');
  };
  try {
    const args = [...command(), ...options];
    const module = await playOiler(canvas, args, {...firstFiles(), ...files}, {
      printErr: line => remarks.push(line),
      onTitle: title => { document.title = title; },
      onText: tell,
      onEnd,
      onRefusal: () => say('This browser refuses to fill the screen.'),
      takeWish() {
        const taken = wish;
        wish = null;
        return taken;
      }
    });
    if (isOver) return;
    const failure = failureIn(remarks, args);
    if (failure) return onEnd(failure);
    shown.module = module;
    if (document.activeElement !== find('text')) canvas.focus({preventScroll: true});
  } catch (error) {
    onEnd(error.message);
  }
}

async function beginAnew(options, files) {
  await play(options, files);
  if (playing.module) say('The browser took the picture away: the game has begun anew.');
}

function tell(line, now, isPaused) {
  find('controls').inert = false;
  if (pausesFirst) pressKey('F3');
  pausesFirst = false;
  showLine(line);
  find('pause').ariaPressed = isPaused;
  if (now === setting) return;
  setting = now;
  usualSetting ??= now;
  showSetting();
  keepLink();
}

// Keys and settings

function sendKey(type, code) {
  find('canvas').dispatchEvent(new KeyboardEvent(type, {code, key: code, bubbles: true}));
}

function pressKey(code) {
  sendKey('keydown', code);
  sendKey('keyup', code);
}

for (const button of document.querySelectorAll('[data-code]')) {
  const {code} = button.dataset;
  // The game keeps the focus.
  button.addEventListener('mousedown', event => event.preventDefault());
  button.addEventListener('pointerdown', () => {
    if (document.activeElement === find('rate')) find('canvas').focus();  // takes what was typed
    sendKey('keydown', code);
  });
  for (const type of ['pointerup', 'pointerleave', 'pointercancel'])
    button.addEventListener(type, () => sendKey('keyup', code));
  button.addEventListener('click', event => {
    if (event.detail === 0) pressKey(code);  // by the keyboard
  });
}

function showSetting() {
  if (setting === '') return;
  const [method, rate] = setting.split('@');
  if (![...find('method').options].some(option => option.value === method))
    find('method').append(new Option(method));
  find('method').value = method;
  if (!isTyping) find('rate').value = rate;
}

async function listMethods() {
  const {failure, output} = await runOiler(['oiler', 'methods', '--json', '-'], {}).result;
  if (failure !== '') return;  // the game tells why
  find('method').replaceChildren(...JSON.parse(output.join('')).map(({name}) => new Option(name)));
  showSetting();
}

find('rate').addEventListener('input', () => { isTyping = true; });
find('rate').addEventListener('blur', () => { isTyping = false; });
let settingTimer;
for (const id of ['rate', 'method'])
  find(id).addEventListener('change', () => {
    isTyping = false;
    if (setting === '') return;  // there was no game yet
    say('');
    if (!find('rate').checkValidity()) {
      say('A rate is a whole number from 1 to 1,000,000 Hz.');
      return showSetting();
    }
    const wanted = wish = `${find('method').value}@${find('rate').valueAsNumber}`;
    if (!playing?.module) return play();
    clearTimeout(settingTimer);
    settingTimer = setTimeout(() => {
      showSetting();
      if (setting !== wanted) say('This game keeps its setting.');
    }, 1000);
  });

function fixSetting(isFixed) {
  for (const id of ['rate', 'method']) find(id).disabled = isFixed;
}

// Link

const isOfList = text => game.file && (game.text === undefined || text === game.text);
// A link has no longer scene than a file.
const hasLink = () =>
  !isScene() || new TextEncoder().encode(find('text').value).length <= longestScene;
async function link() {
  const text = find('text').value;
  const what = !isScene() ? game.name
    : isOfList(text) ? `scene=${game.file}` : await linkOfText(text);
  const chosen = wish ?? setting;
  return `#${what}${!chosen || chosen === usualSetting ? '' : `&setting=${chosen}`}`;
}

let linkTimer;
function keepLink() {
  clearTimeout(linkTimer);
  if (!hasLink()) return;
  linkTimer = setTimeout(async () => history.replaceState(null, '', await link()), 500);
}

find('copy').addEventListener('click', async () => {
  clearTimeout(linkTimer);
  if (!hasLink()) return say('This scene is too long for a link: keep it as a file.');
  history.replaceState(null, '', await link());
  try {
    await navigator.clipboard.writeText(location.href);
    say('Link copied.');
  } catch {
    say('The address of this page is the link: copy it.');
  }
});

// Recordings and files

find('record').addEventListener('click', async () => {
  if (playing?.isRecording) return end();
  const {name: recordedGame} = game;
  find('record').disabled = true;
  await play([...chosenOptions(), '--record', recordingFile]);
  find('record').disabled = false;
  const recorded = playing, {module} = recorded, recordedPlay = plays;
  if (!module) return;
  setRecording(recorded, true);
  await recorded.ended;
  setRecording(recorded, false);
  if (!module.FS.analyzePath(recordingFile).exists) return;  // the game told why
  const name = `${recordedGame}.rec`;
  save(module.FS.readFile(recordingFile), name);
  if (plays === recordedPlay) await play();
  await queue;
  say(`${name} is saved: open it here, or give it to ${recordedGame} --replay.`);
});

function setRecording(of, isRecording) {
  of.isRecording = isRecording;
  find('record').textContent = isRecording ? 'Stop and save' : 'Record';
}

function save(bytes, download) {
  const href = URL.createObjectURL(new Blob([bytes]));
  Object.assign(document.createElement('a'), {href, download}).click();
  setTimeout(() => URL.revokeObjectURL(href), 60000);
}

// One file after the other.
function open(file) {
  begun = begun.catch(() => {}).then(() => read(file));
}

async function read(file) {
  if (file.size > 1 << 28) return complain('This file is too large: give a scene or a recording.');
  const bytes = new Uint8Array(await file.arrayBuffer());
  const [magic, header] = new TextDecoder().decode(bytes.subarray(0, 65536)).split('\n', 2);
  if (magic.startsWith('OILERREC')) return replay(bytes, header);
  if (bytes.length > longestScene)
    return complain('This file is too long: a scene has at most 64 KiB.');
  let text;
  try {
    text = new TextDecoder('utf-8', {fatal: true}).decode(bytes);
  } catch {
    return complain('This file is not UTF-8 text: save the scene as UTF-8.');
  }
  location.hash = await linkOfText(text);
}

async function replay(bytes, header) {
  let name;
  try {
    name = JSON.parse(header).game;
  } catch {
    return complain('This recording is damaged: record again.');
  }
  if (!isDemo(name))
    return complain('This recording is of a game that is not here: replay it with its program.');
  const before = {game, usualSetting, setting};
  const hasGame = playing !== null || game.text !== undefined;
  if (name !== game.name) {
    show({name});
    usualSetting = setting = '';  // unknown: links name the setting
  }
  await play(['--replay', recordingFile], {[recordingFile]: bytes});
  if (!hasGame || playing.module || find('problem').hidden) return;
  const reason = find('problem').textContent;
  show(before.game);
  ({usualSetting, setting} = before);
  await play();
  complain(reason);
}

find('file').addEventListener('change', ({target}) => {
  if (target.files[0]) open(target.files[0]);
  target.value = '';
});
document.addEventListener('dragover', event => event.preventDefault());
document.addEventListener('drop', event => {
  event.preventDefault();
  const [file] = event.dataTransfer.files;
  if (file) open(file);
});

// Begin

const isDemo = name => oilerList.demos.some(demo => demo.name === name);
const isListed = file => oilerList.scenes.some(scene => scene.file === file);

// The text of a scene of the list comes with the program.
function setReady(isReady) {
  find('text').readOnly = !isReady;
  for (const button of document.querySelectorAll('#bits, [data-command]'))
    button.disabled = !isReady;
}

function showTitle() {
  const file = isOfList(find('text').value) ? game.file : 'A scene';
  find('title').textContent = game.name?.replaceAll('_', ' ') ?? file;
  find('canvas').ariaLabel = `Picture of ${find('title').textContent}`;
}

function show(newGame) {
  game = newGame;
  usualSetting = null;
  clearTimeout(typing);
  checking?.cancel();
  showTitle();
  find('scene').hidden = !isScene();
  find('record').hidden = isScene();
  find('lab').hidden = !isScene() || find('results').textContent === '';
  document.body.classList.toggle('scene', isScene());
  setReady(!game.file || game.text !== undefined);
}

async function begin() {
  const first = 'Choose a demo or a scene on the first page.';
  let link;
  try {
    link = await readLink(location.hash);
  } catch {
    return complain(`This link is damaged: ask for it again. ${first}`);
  }
  const {setting: linked, ...linkedGame} = link;
  if (link.text === undefined && !isDemo(link.name) && !isListed(link.file))
    return complain(`There is no such demo or scene. ${first}`);
  show(linkedGame);
  listMethods();
  find('text').value = game.text ?? '';
  if (link.text !== undefined && !await readScene()) return;
  if (linked) usualSetting = '';
  await play(linked ? settingOptions(linked) : []);
  await queue;  // of another setting, chosen meanwhile
  if (!playing.module && linked) {
    const reason = find('problem').textContent;
    usualSetting = null;
    await play([]);
    complain(reason);
  }
  if (!playing.module) return;
  if (game.file) {
    find('text').value = playing.module.FS.readFile(scenePath(), {encoding: 'utf8'});
    game.text = find('text').value;
    setReady(true);
    readScene();
  }
}

addEventListener('hashchange', () => location.reload());
addEventListener('beforeunload', event => { if (playing?.isRecording) event.preventDefault(); });
let begun;
addEventListener('DOMContentLoaded', () => { begun = begin(); });
