// SPDX-License-Identifier: MIT
'use strict';

function card(link, picture, name, text) {
  const image = Object.assign(new Image(240, 135), {src: `pictures/${picture}.png`, alt: ''});
  image.loading = 'lazy';
  const anchor = Object.assign(document.createElement('a'), {href: `play.html#${link}`});
  const title = Object.assign(document.createElement('strong'), {textContent: name});
  const words = Object.assign(document.createElement('span'), {textContent: text});
  anchor.append(image, title, words);
  const item = document.createElement('li');
  item.append(anchor);
  return item;
}

function showAll() {
  document.querySelector('#demos').append(
    ...oilerList.demos.map(({name, text}) => card(name, name, name.replaceAll('_', ' '), text)));
  document.querySelector('#scenes').append(
    ...oilerList.scenes.map(({file, title}) => card(
      `scene=${file}`, `scene_${file.replace('.toml', '')}`, title, file)));

  // The wheel scrolls the page: the jump has no use for it.
  document.querySelector('.screen').addEventListener(
    'wheel', event => event.stopPropagation(), {capture: true});

  const problem = document.querySelector('#problem');
  function tell(reason) {
    problem.textContent = reason;
    problem.hidden = reason === '';
  }
  const showLine = slowly(document.querySelector('#line'));
  playOiler(document.querySelector('#canvas'), ['jump'], {}, {
    onText: showLine,
    onEnd: reason => tell(reason || 'The jump has ended: reload the page.')
  }).catch(error => tell(error.message));
}

// The page of a game begins with the game.
if (oilerList.demos.length === 1) location.replace('play.html');
else showAll();
