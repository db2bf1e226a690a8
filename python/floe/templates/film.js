/* Pictures through time: one at a time, by a slider, the arrow keys, or played. Without this script all of them stand side by side. */
document.querySelectorAll('.film').forEach(film => {
  const frames = [...film.querySelectorAll('figure')], control = film.querySelector('.control');
  const slider = control.querySelector('input'), play = control.querySelector('button');
  let timer = 0;
  const show = n => {
    frames.forEach((frame, k) => { frame.hidden = k !== n; });
    slider.value = n;
    slider.setAttribute('aria-valuetext', frames[n].querySelector('figcaption').textContent);
  };
  const stop = () => { clearInterval(timer); timer = 0; play.textContent = 'Play'; };
  slider.addEventListener('input', () => { stop(); show(Number(slider.value)); });
  play.addEventListener('click', () => {
    if (timer) { stop(); return; }
    play.textContent = 'Stop';
    timer = setInterval(() => show((Number(slider.value) + 1) % frames.length), 500);
  });
  film.classList.add('live');
  control.hidden = false;
  show(frames.length - 1);
});
