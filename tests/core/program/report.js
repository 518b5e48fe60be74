// SPDX-License-Identifier: GPL-3.0-or-later
// Tries the sliders and the first figures of a page as a reader would, looks at all, and returns what does not answer.
(async function () {
  const faults = [];
  const all = (selector, within) => [...(within || document).querySelectorAll(selector)];
  const drawing = node => node.innerHTML.replace(/(clip|gradient_)\d+/g, '');
  // A drawing is made in steps: waits until it stays.
  async function settled(plot) {
    for (let still = 0, tries = 0, last = ''; still < 3 && tries++ < 500; await new Promise(done => setTimeout(done, 10))) {
      const now = plot.querySelector('svg') ? drawing(plot) : '';
      still = now && now === last ? still + 1 : 0;
      last = now;
    }
    return drawing(plot);
  }
  async function changes(what, plot, action) {
    const before = await settled(plot);
    action();
    if (await settled(plot) === before) faults.push(`${what} changes nothing`);
    look(what, plot);
  }
  function look(what, plot) {
    if (!plot.querySelector('svg') || /NaN|Infinity|undefined/.test(plot.innerHTML.replace(/data:[^"]*/g, ''))) faults.push(`${what}: a place is no number`);
    if (plot.parentNode.scrollWidth > plot.parentNode.clientWidth + 1) faults.push(`${what}: wider than its frame`);
  }
  function point(plot, kind, x, y) {
    const box = plot.querySelector('svg').getBoundingClientRect();
    (kind === 'pointerup' ? window : plot).dispatchEvent(new MouseEvent(kind, {clientX: box.left + x * box.width,
      clientY: box.top + y * box.height, button: 0, bubbles: true}));
  }
  async function saved(button) {
    const link = HTMLAnchorElement.prototype.click, store = URL.createObjectURL;
    const blob = new Promise(done => { URL.createObjectURL = done; });
    HTMLAnchorElement.prototype.click = () => {};
    button.click();
    const svg = await (await blob).text();
    Object.assign(URL, {createObjectURL: store});
    HTMLAnchorElement.prototype.click = link;
    return !/var\(/.test(svg) && !new DOMParser().parseFromString(svg, 'image/svg+xml').querySelector('parsererror');
  }
  async function tryFigure(figure) {
    const plot = figure.querySelector('.plot'), name = figure.querySelector('figcaption span').textContent;
    const buttons = all('.buttons button', figure), called = words => buttons.find(b => words.test(b.textContent));
    const key = figure.querySelector('.keys button'), first = await settled(plot);
    look(name, plot);
    point(plot, 'mousemove', 0.5, 0.5);
    await changes(`${name}: dragging`, plot, () => { point(plot, 'pointerdown', 0.4, 0.3); point(plot, 'pointerup', 0.8, 0.7); });
    await changes(`${name}: whole`, plot, () => called(/whole/).click());
    if (drawing(plot) !== first) faults.push(`${name}: not the whole`);
    for (let twice = 0; twice < 2 && key; twice++) await changes(`${name}: a toggle`, plot, () => key.click());
    for (let twice = 0; twice < 2 && called(/^(log|linear)$/); twice++) await changes(`${name}: log`, plot, () => called(/^(log|linear)$/).click());
    if (!await saved(called(/save/))) faults.push(`${name}: what is saved is broken`);
  }
  async function trySlider(section) {
    const slider = section.querySelector('input'), play = section.querySelector('.play'), plots = all('.plot', section);
    for (const at of [0, Math.floor(slider.max / 2)]) {
      const before = await Promise.all(plots.map(settled));
      slider.value = at;
      slider.dispatchEvent(new Event('input'));
      const after = await Promise.all(plots.map(settled));
      if (after.some((one, i) => one === before[i])) faults.push(`the slider at ${at} leaves a figure as it was`);
      plots.forEach(plot => look('the slider', plot));
    }
    play.click();
    if (play.textContent !== 'pause') faults.push('play does not play');
    play.click();
  }
  all('details').forEach(one => { one.open = true; });
  await Promise.all(all('.plot').map(settled)); // those that were hidden, too
  for (const section of all('.snapshots')) await trySlider(section);
  all('.plot').forEach(plot => look(plot.parentNode.querySelector('figcaption span').textContent, plot));
  for (const figure of all('figure').filter(one => one.querySelector('.plot')).slice(0, 5)) await tryFigure(figure); // of a page they have the same script
  return faults;
})()
