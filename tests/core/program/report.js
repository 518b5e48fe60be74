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
  // What a click on a button would store.
  async function stored(button) {
    const link = HTMLAnchorElement.prototype.click, store = URL.createObjectURL;
    const blob = new Promise(done => { URL.createObjectURL = done; });
    HTMLAnchorElement.prototype.click = () => {};
    button.click();
    const file = await blob;
    Object.assign(URL, {createObjectURL: store});
    HTMLAnchorElement.prototype.click = link;
    return file;
  }
  async function tryStored(name, called) {
    const svg = await (await stored(called(/save/))).text();
    if (/var\(/.test(svg) || new DOMParser().parseFromString(svg, 'image/svg+xml').querySelector('parsererror')) faults.push(`${name}: what is saved is broken`);
    const png = await createImageBitmap(await stored(called(/png/)));
    if (png.width < 500) faults.push(`${name}: the picture is ${png.width} wide`);
    const csv = (await (await stored(called(/csv/))).text()).trim().split('\n');
    if (csv.length < 2 || csv[1].split(',').length < 3) faults.push(`${name}: no numbers in ${csv[0]}`);
  }
  // Sorts by each column, up and down, filters, and stores the rows.
  async function tryTable(table) {
    const body = table.tBodies[0], count = body.rows.length, tools = table.parentNode.previousSibling;
    [...table.tHead.rows[0].cells].forEach((head, k) => {
      for (const way of head.tabIndex === 0 ? ['ascending', 'descending'] : []) {
        head.click();
        const list = [...body.rows].map(row => row.cells[k] && row.cells[k].dataset.v).filter(v => v !== undefined).map(Number);
        if (head.getAttribute('aria-sort') !== way) faults.push(`${head.textContent} is not ${way}`);
        if (list.some((v, i) => i && (way === 'ascending' ? v < list[i - 1] : v > list[i - 1]))) faults.push(`${head.textContent} is not sorted ${way}`);
      }
    });
    const csv = (await (await stored(tools.querySelector('button'))).text()).trim();
    if (body.rows.length !== count || csv.split('\n').length < count + 1) faults.push('a table loses rows');
    const filter = tools.querySelector('input');
    for (const words of filter ? [body.rows[0].cells[0].textContent, 'no such words', ''] : []) {
      filter.value = words;
      filter.dispatchEvent(new Event('input'));
      const seen = [...body.rows].filter(row => !row.hidden).length;
      if (words ? (seen > 0) !== (words !== 'no such words') : seen !== count) faults.push(`the filter "${words}" leaves ${seen} rows`);
    }
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
    await tryStored(name, called);
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
  for (const tools of all('.tools').slice(0, 5)) await tryTable(tools.nextSibling.querySelector('table'));
  return faults;
})()
