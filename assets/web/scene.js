// SPDX-License-Identifier: MIT
// The text of a scene, and commands in a worker that measure it.
'use strict';

let checking = null;
let measuring = null;
let typing;

function showMistake(failure) {
  const [, line, words] = /:(\d+): (.*)/.exec(failure) ?? [];
  find('text').classList.toggle('wrong', line !== undefined);
  find('text').style.setProperty('--wrong', line ?? 1);
  find('text').ariaInvalid = failure !== '';
  find('mistake').textContent = line ? `Line ${line}: ${words}` : failure;
}

// Returns whether the text is a scene. Shows its mistake.
async function readScene() {
  checking?.cancel();
  checking = runOiler([...command(), '--steps', '0', '--quiet', '--json', '-'], sceneFiles());
  const {failure, output} = await checking.result;
  if (failure !== null) showMistake(failure);
  if (failure !== '') return false;
  const {method, rate} = JSON.parse(output.join(''));
  usualSetting = `${method}@${rate}`;
  return true;
}

// The program reads a changed file again.
async function playText() {
  const text = find('text').value;
  keepLink();
  if (!await readScene()) return;
  if (!playing?.module) return play();
  playing.module.FS.writeFile(scenePath(), text);
}

const ofEarlierText = 'Of the scene before it was edited:\n';
find('text').addEventListener('input', () => {
  clearTimeout(typing);
  showMistake('');
  showTitle();
  say('');
  if (!find('lab').hidden && !find('results').textContent.startsWith(ofEarlierText))
    find('results').prepend(ofEarlierText);
  typing = setTimeout(playText, 200);
});

// Shows the lines of a command as they come, and how far it is.
async function measure(args) {
  measuring?.cancel();
  say('');
  find('lab').hidden = find('busy').hidden = false;
  find('results').textContent = find('progress').textContent = '';
  find('results').ariaBusy = true;
  find('lab').scrollIntoView({block: 'nearest'});
  const job = measuring = runOiler(args, sceneFiles(), line => {
    const [progress, ending] = line.split('; --time-limit');
    if (ending) find('progress').textContent = progress;
    else find('results').append(line, '\n');
  });
  const {failure} = await job.result;
  if (job !== measuring) return;
  find('busy').hidden = true;
  find('results').ariaBusy = false;
  say(failure === null ? 'Cancelled.'
    : failure ? 'The command has failed.' : 'The results are complete.');
}

for (const button of document.querySelectorAll('[data-command]'))
  button.addEventListener('click', () => {
    const {command: name} = button.dataset;
    if (name === 'advise' && !find('pixels').reportValidity()) return;
    const tolerance = name === 'advise' ? ['--pixels', find('pixels').value] : [];
    measure(['oiler', name, scenePath(), ...tolerance]);
  });
find('cancel').addEventListener('click', () => measuring.cancel());

// Compares the state hash after 600 steps with that of the native program.
find('bits').addEventListener('click', async () => {
  say('Playing 600 steps…');
  const options = chosenOptions();
  const isNative = options.length === 0 && (!isScene() || isOfList(find('text').value));
  const run = [...command(), ...options, '--steps', '600', '--quiet', '--json', '-'];
  const {failure, output} = await runOiler(run, sceneFiles()).result;
  if (failure !== '') return say(failure);
  const {state_hash: hash, steps, method, rate} = JSON.parse(output.join(''));
  const native = isNative ? oilerList.hashes[game.name ?? game.file] : undefined;
  const verdict = native === undefined ? '' :
    native === hash ? ': equal to the native program' : `: the native program has ${native}`;
  say(`State hash after ${steps} steps of ${method} at ${rate} Hz: ${hash}${verdict}.`);
});
