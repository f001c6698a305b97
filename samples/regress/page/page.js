'use strict';
// The wipe: a range input lies over the pictures, so that mouse, touch and keys all move it.
for (const stack of document.querySelectorAll('.stack')) {
  const slider = stack.querySelector('input');
  const move = () => stack.style.setProperty('--at', slider.value + '%');
  slider.addEventListener('input', move);
  // A range input's thumb has a width: where the pointer is counts, not where the thumb's middle can be.
  const follow = event => {
    const box = stack.getBoundingClientRect();
    slider.value = 100 * (event.clientX - box.left) / box.width;
    move();
  };
  slider.addEventListener('pointerdown', follow);
  slider.addEventListener('pointermove', event => { if (event.buttons & 1) follow(event); });
  slider.addEventListener('pointerup', event => requestAnimationFrame(() => follow(event)));
  move();
}
// A link to a case opens it.
const openTarget = () => {
  const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (target) target.open = true;
};
addEventListener('hashchange', openTarget);
openTarget();
