(function () {
  'use strict';
  function all(selector, within) {
    return Array.prototype.slice.call((within || document).querySelectorAll(selector));
  }
  function make(tag, name, words) {
    var node = document.createElement(tag);
    if (name) node.className = name;
    if (words !== undefined) node.textContent = words;
    return node;
  }
  function download(blob, name) {
    var link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(function () { URL.revokeObjectURL(link.href); }, 1000);
  }
  function save(figure, name) {
    figures.standalone(figure).then(function (svg) { download(new Blob([svg], {type: 'image/svg+xml'}), name + '.svg'); });
  }
  /* Saves a figure as a picture of twice its size, on an opaque background. */
  function picture(figure, name) {
    figures.standalone(figure).then(function (svg) {
      var image = new Image(), canvas = document.createElement('canvas'), pen = canvas.getContext('2d');
      image.onload = function () {
        canvas.width = 2 * image.width;
        canvas.height = 2 * image.height;
        pen.fillStyle = '#fff';
        pen.fillRect(0, 0, canvas.width, canvas.height);
        pen.drawImage(image, 0, 0, canvas.width, canvas.height);
        canvas.toBlob(function (blob) { download(blob, name + '.png'); });
      };
      image.src = 'data:image/svg+xml,' + encodeURIComponent(svg);
    });
  }
  function write(rows, name) { /* CSV by RFC 4180 */
    download(new Blob([rows.map(function (row) {
      return row.map(function (cell) {
        var words = cell === null || cell === undefined ? '' : String(cell);
        return /[",\n]/.test(words) ? '"' + words.replace(/"/g, '""') + '"' : words;
      }).join(',');
    }).join('\n') + '\n'], {type: 'text/csv'}), name + '.csv');
  }
  /* The numbers of a figure as rows of a table. */
  function numbers(figure) {
    var rows = [];
    if (figure.sort === 'curves') {
      var bars = figure.curves.some(function (c) { return c.bar; });
      figure.curves.forEach(function (curve) {
        curve.x.forEach(function (x, i) {
          rows.push([curve.names ? curve.names[i] : curve.name || '', figure.names ? figure.names[i] : x, curve.y[i]].concat(bars ? [curve.bar ? curve.bar[i] : null] : []));
        });
      });
      return [['', figure.x.label, figure.y.label].concat(bars ? ['error'] : [])].concat(rows);
    }
    figure.y.at.forEach(function (y, r) {
      figure.x.at.forEach(function (x, c) {
        var k = r * figure.x.at.length + c;
        rows.push(figure.values ? [y, x, figure.values[r][c]] : [y, x, figure.classes[figure.cells[k]].name, figure.reasons[k]]);
      });
    });
    return [[figure.y.label, figure.x.label, figure.value ? figure.value.label : 'class']].concat(rows);
  }

  /* Tables. A click on a head sorts the rows, a second click reverses the order. Numbers are sorted by their SI values. */
  function keyOf(cell) {
    var words = cell.textContent.replace(/[\u202f\u2009\u00a0]/g, '').trim();
    var number = cell.dataset.v === undefined ? parseFloat(words.replace(/^\u2265/, '')) : Number(cell.dataset.v);
    return isNaN(number) ? words : number;
  }
  function order(a, b) { /* numbers before words, empty cells last */
    if (typeof a === typeof b) return typeof a === 'number' ? a - b : (a === '') - (b === '') || a.localeCompare(b);
    return typeof a === 'number' ? -1 : 1;
  }
  function sorting(table, number) {
    var body = table.tBodies[0], heads = Array.prototype.slice.call(table.tHead.rows[0].cells);
    heads.forEach(function (head, k) {
      if (!head.textContent) return;
      head.tabIndex = 0;
      function sort() {
        var back = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
        heads.forEach(function (one) { one.removeAttribute('aria-sort'); });
        head.setAttribute('aria-sort', back < 0 ? 'descending' : 'ascending');
        Array.prototype.map.call(body.rows, function (row, i) { return {row: row, key: row.cells[k] ? keyOf(row.cells[k]) : '', at: i}; })
          .sort(function (a, b) { return back * order(a.key, b.key) || a.at - b.at; })
          .forEach(function (one) { body.appendChild(one.row); });
      }
      head.addEventListener('click', sort);
      head.addEventListener('keydown', function (e) { if (e.key === 'Enter') sort(); });
    });
    var tools = make('div', 'tools');
    button('csv', tools, function () {
      write([table.tHead.rows[0]].concat(Array.prototype.slice.call(body.rows)).map(function (row) {
        return Array.prototype.map.call(row.cells, function (cell, k) {
          var unit = heads[k] && heads[k].dataset.unit, words = cell.textContent.replace(/[\u202f\u2009]/g, '').trim();
          if (unit === undefined) return words;
          return cell.tagName === 'TH' ? words + (unit === '1' ? '' : ' [' + unit + ']') : cell.dataset.v === undefined ? '' : cell.dataset.v;
        });
      }), 'table-' + (number + 1));
    });
    table.parentNode.parentNode.insertBefore(tools, table.parentNode);
  }
  /* Adds a search box: only rows that contain all its words are shown. */
  function filtering(table) {
    var box = make('input'), body = table.tBodies[0];
    box.type = 'search';
    box.placeholder = 'show rows with \u2026';
    box.setAttribute('aria-label', box.placeholder);
    box.addEventListener('input', function () {
      var words = box.value.toLowerCase().split(/\s+/);
      Array.prototype.forEach.call(body.rows, function (row) {
        var own = row.textContent.toLowerCase();
        row.hidden = !words.every(function (word) { return own.indexOf(word) >= 0; });
      });
    });
    table.parentNode.previousSibling.appendChild(box);
  }

  /* The figures of the page. */
  var shown = [], printing = false; /* a figure in a closed part of the page is drawn when the part is opened */
  function drawn() { return shown.filter(function (f) { return f.view; }); }
  function draw(f) {
    if (f.view) f.view.finalize();
    f.box.textContent = '';
    f.width = Math.max(260, f.box.clientWidth || 600);
    if (printing || matchMedia('print').matches) f.width = Math.min(f.width, 640);
    f.view = figures.view(f.figure, f.width);
    f.whole.hidden = !f.figure.xd;
    return f.view.initialize(f.box).runAsync();
  }
  function zoom(f, xd, yd) {
    f.figure.xd = xd;
    f.figure.yd = yd;
    return draw(f);
  }
  function place(f, event) {
    var box = f.box.querySelector('svg').getBoundingClientRect(), origin = f.view.origin();
    return [event.clientX - box.left - origin[0], event.clientY - box.top - origin[1]];
  }
  function dragging(f) {
    var start = null, brush = make('div', 'brush');
    brush.hidden = true;
    f.node.appendChild(brush);
    function inside(p) {
      return [Math.min(Math.max(p[0], 0), f.view.signal('width')), Math.min(Math.max(p[1], 0), f.view.signal('height'))];
    }
    f.box.addEventListener('pointerdown', function (e) { if (e.button === 0) start = [inside(place(f, e)), e.clientX, e.clientY]; });
    window.addEventListener('pointermove', function (e) {
      if (!start) return;
      var box = f.node.getBoundingClientRect();
      brush.hidden = false;
      brush.style.left = Math.min(start[1], e.clientX) - box.left + 'px';
      brush.style.top = Math.min(start[2], e.clientY) - box.top + 'px';
      brush.style.width = Math.abs(e.clientX - start[1]) + 'px';
      brush.style.height = Math.abs(e.clientY - start[2]) + 'px';
      e.preventDefault();
    });
    window.addEventListener('pointerup', function (e) {
      if (!start) return;
      var a = start[0], b = inside(place(f, e)), x = f.view.scale('x'), y = f.view.scale('y');
      start = null;
      brush.hidden = true;
      if (Math.abs(a[0] - b[0]) < 6) return;
      var flat = Math.abs(a[1] - b[1]) < 12, yd = f.view.signal('yd');
      zoom(f, [x.invert(Math.min(a[0], b[0])), x.invert(Math.max(a[0], b[0]))],
        flat ? yd : [y.invert(Math.max(a[1], b[1])), y.invert(Math.min(a[1], b[1]))]);
    });
    f.box.addEventListener('dblclick', function () { zoom(f); });
  }

  /* Shows the values at the pointer. */
  var tip = make('div');
  tip.id = 'tip';
  tip.hidden = true;
  document.body.appendChild(tip);
  function nearby(f, p) {
    var lines = [], x = f.view.scale('x'), y = f.view.scale('y'), figure = f.figure;
    if (figure.sort !== 'curves') {
      var c = Math.floor(x.invert(p[0])), r = Math.floor(y.invert(p[1]));
      if (!(c >= 0 && r >= 0 && c < figure.x.at.length && r < figure.y.at.length)) return [];
      lines = [figure.x.label + ': ' + figures.text(figure.x.at[c]), figure.y.label + ': ' + figures.text(figure.y.at[r])];
      if (figure.sort === 'map') lines.push(figure.value.label + ': ' + (figure.values[r][c] === null ? 'none' : figures.text(figure.values[r][c])));
      else lines = lines.concat(figure.reasons[r * figure.x.at.length + c].split('; '));
      return lines;
    }
    figure.curves.forEach(function (curve) {
      var best = -1, least = curve.names ? 15 : 12;
      if (curve.hidden) return;
      curve.x.forEach(function (value, i) {
        if (value === null || curve.y[i] === null) return;
        var d = curve.style === 'dots' ? Math.hypot(x(value) - p[0], y(curve.y[i]) - p[1]) : Math.abs(x(value) - p[0]);
        if (d < least) { least = d; best = i; }
      });
      if (best < 0) return;
      lines.push((figure.names ? figure.names[best] + ': ' : curve.names ? curve.names[best] + ': ' : curve.name ? curve.name + ': ' : '') + figures.text(curve.y[best]) +
        (curve.bar ? ' ± ' + figures.text(parseFloat(curve.bar[best].toPrecision(2))) : '') + (curve.style === 'dots' ? ' at ' + figures.text(curve.x[best]) : ''));
    });
    if (lines.length && !figure.names) lines.unshift(figure.x.label + ': ' + figures.text(x.invert(p[0])));
    return lines;
  }
  function show(f, event) {
    var p = place(f, event), lines = [];
    if (p[0] >= 0 && p[0] <= f.view.signal('width') && p[1] >= 0 && p[1] <= f.view.signal('height')) lines = nearby(f, p);
    tip.textContent = lines.join('\n');
    tip.hidden = lines.length === 0;
    tip.style.left = Math.max(4, Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 8)) + 'px';
    tip.style.top = event.clientY + 14 + 'px';
  }

  function button(words, into, action) {
    var made = make('button', '', words);
    made.type = 'button';
    made.addEventListener('click', action);
    into.appendChild(made);
    return made;
  }
  function keys(f) {
    var list = make('div', 'keys');
    f.figure.curves.forEach(function (curve) {
      if (!curve.name) return;
      var key = button('', list, function () {
        curve.hidden = !curve.hidden;
        key.setAttribute('aria-pressed', String(!curve.hidden));
        draw(f);
      });
      var swatch = make('i', curve.style === 'dots' ? 'dot' : 'd' + curve.dash % figures.dashes);
      swatch.style.color = figures.ink(curve.colour);
      key.appendChild(swatch);
      key.appendChild(document.createTextNode(curve.name));
      key.setAttribute('aria-pressed', 'true');
      key.title = 'show or hide';
    });
    if (list.firstChild) f.node.insertBefore(list, f.box);
  }
  function classList(f) {
    var list = make('div', 'keys');
    f.figure.classes.forEach(function (kind, k) {
      var count = f.figure.cells.filter(function (c) { return c === k; }).length;
      if (!count) return;
      var item = make('span', 'class'), swatch = make('b', '', kind.letter);
      swatch.style.background = kind.colour;
      item.appendChild(swatch);
      item.appendChild(document.createTextNode(count + ' ' + kind.name + ': ' + kind.text));
      list.appendChild(item);
    });
    f.node.insertBefore(list, f.node.querySelector('details'));
  }
  /* Whether an axis can be logarithmic. */
  function positive(figure, axis) {
    return figure.curves.every(function (c) {
      return c.style !== 'bars' && !c.live && figures.finite(c[axis]).every(function (v) { return v > 0; });
    });
  }
  /* Returns the description of a figure. Figures of a study have a script element with the description, or with numbers from which
   * answers.js makes it. Other figures already have theirs as `figure`. */
  function descriptionOf(node) {
    var lying = node.figure || JSON.parse(node.querySelector('script').textContent), made = answers[lying.sort];
    node.figure = made ? made(lying) : lying;
    if (node.figure.note) node.insertBefore(make('p', 'note', node.figure.note), node.querySelector('figcaption').nextSibling);
    return node.figure;
  }
  function begin(node, number) {
    var f = {node: node, figure: descriptionOf(node), box: make('div', 'plot')};
    var buttons = make('span', 'buttons'), figure = f.figure;
    figure.title = node.querySelector('figcaption').textContent;
    node.querySelector('figcaption').appendChild(buttons);
    node.insertBefore(f.box, node.querySelector('.note, details'));
    f.whole = button('whole', buttons, function () { zoom(f); });
    f.whole.hidden = true;
    if (figure.sort === 'curves' && positive(figure, 'y'))
      button(figure.y.log ? 'linear' : 'log', buttons, function (e) {
        figure.y.log = figure.y.log ? 0 : 1;
        figure.xd = figure.yd = undefined;
        e.target.textContent = figure.y.log ? 'linear' : 'log';
        draw(f);
      });
    button('save', buttons, function () { save(figure, 'figure-' + (number + 1)); });
    button('png', buttons, function () { picture(figure, 'figure-' + (number + 1)); });
    button('csv', buttons, function () { write(numbers(figure), 'figure-' + (number + 1)); });
    if (figure.sort === 'curves') keys(f);
    if (figure.sort === 'classes') classList(f);
    if (figure.sort === 'map') node.appendChild(make('small', '', 'Lines join equal values' +
      (figure.mark === undefined ? '.' : '; the thick one is the limit of ' + figures.text(figure.mark) + '.') + (figure.best ? ' \u2605 the best.' : '') +
      (/[12]/.test((figure.standing || []).join('')) ? ' Crossed out: a limit is missed; framed: it is met only within its error bar.' : '')));
    if (figure.sort === 'classes' && figure.edges.length) node.insertBefore(make('small', '',
      'Black lines: the boundary between two cells, found by bisection.'), node.querySelector('details'));
    f.box.addEventListener('mousemove', function (event) { show(f, event); });
    f.box.addEventListener('mouseleave', function () { tip.hidden = true; });
    dragging(f);
    if (!node.closest('details:not([open])')) draw(f);
    shown.push(f);
  }

  function tableOf(head, rows) {
    var table = make('table'), wide = make('div', 'wide');
    [head].concat(rows).forEach(function (cells, i) {
      var tr = make('tr');
      cells.forEach(function (cell) {
        tr.appendChild(make(i ? 'td' : 'th', i && typeof cell === 'number' ? 'number' : '', cell === null ? '–' : figures.text(cell)));
      });
      table.appendChild(tr);
    });
    wide.appendChild(table);
    return wide;
  }
  /* Without the plotting library, shows the numbers of a figure as a table of about 40 rows. */
  function tabulate(node) {
    var rows = numbers(descriptionOf(node)), step = Math.ceil(rows.length / 40);
    node.appendChild(tableOf(rows[0], rows.slice(1).filter(function (_, i) { return i % step === 0; })));
  }

  /* The parts of the page that choose.js fills. */
  function closest(list, value) {
    var best = 0;
    for (var i = 1; i < list.length; i++)
      if (Math.abs(list[i] - value) < Math.abs(list[best] - value)) best = i;
    return best;
  }
  function player(section, chosen) {
    var bar = make('p', 'player'), slider = make('input');
    slider.type = 'range';
    slider.min = 0;
    slider.max = chosen.stages[0].frames - 1;
    slider.value = chosen.start;
    slider.setAttribute('aria-label', 'instant of the engagement');
    button('play', bar, function () {}).className = 'play';
    bar.appendChild(slider);
    bar.appendChild(make('output'));
    section.appendChild(bar);
    section.classList.add('snapshots');
    section.chosen = chosen;
  }
  function put(list, into) {
    list.forEach(function (one) {
      if (one.folded) {
        var details = make('details', 'broad'), inside = make('div', 'figures');
        details.appendChild(make('summary', '', one.folded));
        details.appendChild(inside);
        put(one.figures, inside);
        into.appendChild(details);
        return;
      }
      var node = make('figure', one.class), caption = make('figcaption');
      caption.appendChild(make('span', '', one.title));
      node.appendChild(caption);
      node.figure = one;
      into.appendChild(node);
    });
  }
  function choose() {
    var lying = document.getElementById('data'), data = lying && JSON.parse(lying.textContent);
    if (!data) return;
    data.tabled = !!document.querySelector('.grids');
    choice.sections(data).forEach(function (chosen) {
      var section = make('section'), into = make('div', 'figures'), within = section;
      if (chosen.folded) {
        within = make('details');
        within.appendChild(make('summary', '', chosen.title));
        section.appendChild(within);
      } else {
        section.appendChild(make('h2', '', chosen.title));
      }
      if (chosen.stages) player(section, chosen);
      if (chosen.note) within.appendChild(make('p', 'note', chosen.note));
      if (chosen.stages) section.appendChild(make('p', 'extremes'));
      within.appendChild(into);
      put(chosen.figures, into);
      document.getElementById(chosen.at).appendChild(section);
      if (chosen.at === 'over' && data.tabled) document.querySelector('.grids').closest('details').open = false; /* the figures show the same numbers */
    });
  }
  /* The slider chooses an instant of the first stage; the other stages show their nearest instant. */
  function animate(section) {
    var chosen = section.chosen, timer = null, stages = chosen.stages;
    var slider = section.querySelector('input'), play = section.querySelector('.play');
    function frameOf(stage) { return stage === stages[0] ? Number(slider.value) : closest(stage.at, stages[0].at[slider.value]); }
    function part(stage, field) {
      var start = frameOf(stage) * stage.cells;
      return figures.finite(Array.from(stage.values[field].subarray(start, start + stage.cells)));
    }
    function update() {
      var now = stages[0].at[slider.value];
      shown.forEach(function (f) {
        if (!section.contains(f.node)) return;
        f.figure.curves.forEach(function (curve, k) {
          var stage = stages[curve.live[1]], start = frameOf(stage) * stage.cells;
          curve.y = Array.from(stage.values[curve.live[0]].subarray(start, start + stage.cells), function (v) { return isFinite(v) ? v : null; });
          f.view.data('c' + k, figures.points(curve, f.figure));
        });
        f.view.runAsync();
      });
      section.querySelector('.extremes').textContent = stages.map(function (stage) {
        return stage.stage + ': least film ' + figures.text(Math.min.apply(null, part(stage, 'film'))) + ' ' + stages[0].of('film').unit +
          ', highest pressure ' + figures.text(Math.max.apply(null, part(stage, 'pressure'))) + ' ' + stages[0].of('pressure').unit;
      }).join('; ');
      section.querySelector('output').textContent = chosen.time.label + ' ' + figures.text(now) + (chosen.time.unit ? ' ' + chosen.time.unit : '');
    }
    function stop() {
      clearInterval(timer);
      timer = null;
      play.textContent = 'play';
      play.setAttribute('aria-pressed', 'false');
    }
    slider.addEventListener('input', update);
    play.addEventListener('click', function () {
      if (timer) { stop(); return; }
      play.textContent = 'pause';
      play.setAttribute('aria-pressed', 'true');
      timer = setInterval(function () {
        slider.value = (Number(slider.value) + 1) % (Number(slider.max) + 1);
        update();
      }, 60);
    });
    update();
  }

  /* Draws the gear pair of the inputs to scale: teeth with sketched flanks, and the pitch circles. */
  function pair(list) {
    var of = {}, inside = false;
    Array.prototype.forEach.call(list.children, function (node) {
      if (node.tagName === 'DT') inside = /^gear\//.test((node.querySelector('small') || node).textContent);
      else if (inside) all('span', node).forEach(function (one) { of[one.firstChild.textContent.trim()] = one.querySelector('b').textContent; });
    });
    function both(name, otherwise) { /* the values of both gears: lengths in mm, plain numbers unchanged */
      var found = (of[name] || '').match(/-?[\d.]+(e[-+]?\d+)? *[^\d,\]\s]*/gi);
      if (!found) return otherwise;
      found = found.map(function (word) { return parseFloat(word) * ({m: 1e3, cm: 10, um: 1e-3, in: 25.4}[word.replace(/.*[\d. ]/, '')] || 1); });
      return [found[0], found.length > 1 ? found[1] : found[0]];
    }
    var z = both('teeth'), m = both('module'), x = both('profile shift', [0, 0]);
    if (!z || !m || !(z[0] > 2 && z[1] > 2)) return;
    var a = both('centre distance', [m[0] * (z[0] + z[1]) / 2])[0];
    var tips = both('tip diameter', [0, 1].map(function (i) { return m[0] * (z[i] + 2 + 2 * x[i]); }));
    var high = Math.max(tips[0], tips[1]) * 1.02, ns = 'http://www.w3.org/2000/svg', svg = document.createElementNS(ns, 'svg');
    function put(tag, values) {
      var node = document.createElementNS(ns, tag);
      Object.keys(values).forEach(function (key) { node.setAttribute(key, values[key]); });
      svg.appendChild(node);
    }
    [0, 1].forEach(function (i) {
      var tip = tips[i] / 2, root = tip - 2.25 * m[0], step = 2 * Math.PI / z[i], points = [];
      for (var k = 0; k < z[i]; k++) /* gear 1 has a tooth on the line of centres, gear 2 a gap */
        [[-0.36, root], [-0.14, tip], [0.14, tip], [0.36, root]].forEach(function (p) {
          var at = (k + (i ? 0.5 : 0) + p[0]) * step + i * Math.PI;
          points.push((i * a + p[1] * Math.cos(at)).toFixed(3) + ',' + (p[1] * Math.sin(at)).toFixed(3));
        });
      put('path', {d: 'M' + points.join('L') + 'Z'});
      put('circle', {cx: i * a, cy: 0, r: a * z[i] / (z[0] + z[1])});
    });
    svg.setAttribute('viewBox', [-tips[0] / 2 - high / 100, -high / 2, tips[0] / 2 + a + tips[1] / 2 + high / 50, high].join(' '));
    var box = make('div', 'pair');
    box.appendChild(svg);
    box.appendChild(make('small', '', 'to scale: ' + z.join(' and ') + ' teeth, ' + String(Number(a.toPrecision(6))) + ' mm apart; flanks are sketched'));
    list.parentNode.insertBefore(box, list);
  }

  /* If the address ends with #figures: adds all figures to the page as one SVG text that can be saved. Each has its place on the page, or
   * is below the previous one. */
  function spell() {
    return Promise.all(shown.map(function (f) { return figures.standalone(f.figure); })).then(function (list) {
      var width = 0, height = 0, inner = [], rows = {};
      list.forEach(function (svg, i) {
        var place = shown[i].figure.place || [0, i], size = svg.match(/width="([\d.]+)" height="([\d.]+)"/).slice(1).map(Number);
        var origin = svg.match(/translate\(([\d.]+),([\d.]+)\)/).slice(1).map(Number);
        (rows[place[1]] = rows[place[1]] || []).push({svg: svg, size: size, origin: origin, x: shown[i].figure.place ? Math.max(0, place[0] - origin[0]) : 0});
      });
      Object.keys(rows).map(Number).sort(function (a, b) { return a - b; }).forEach(function (key) { /* aligns the axes of the figures in a row */
        var above = Math.max.apply(null, rows[key].map(function (p) { return p.origin[1]; })), bottom = 0;
        rows[key].forEach(function (p) {
          var y = height + above - p.origin[1];
          width = Math.max(width, p.x + p.size[0]);
          bottom = Math.max(bottom, y + p.size[1]);
          inner.push(p.svg.replace('<svg ', '<svg x="' + p.x + '" y="' + y + '" '));
        });
        height = bottom + 10;
      });
      document.body.appendChild(make('pre', 'saved', '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 ' +
        Math.ceil(width) + ' ' + Math.ceil(height) + '" font-family="sans-serif">\n<rect width="100%" height="100%" fill="#fff"/>\n' + inner.join('\n') + '\n</svg>\n'));
    });
  }
  window.addEventListener('load', function () {
    all('.inputs').forEach(pair);
    choose();
    var nodes = all('figure');
    if (window.vega) {
      nodes.forEach(function (node, i) {
        try { begin(node, i); } catch (e) { node.appendChild(make('small', '', 'This figure cannot be drawn: ' + e.message)); }
      });
      all('.snapshots').forEach(animate);
    } else {
      nodes.forEach(tabulate);
      all('.without').forEach(function (note) { note.hidden = false; });
    }
    all('.wide > table:not(.fixed)').filter(function (t) { return t.tHead && t.tBodies[0] && t.tBodies[0].rows.length > 1; }).forEach(function (t, i) {
      sorting(t, i);
      if (t.tBodies[0].rows.length > 12) filtering(t);
    });
    all('details').forEach(function (d) {
      d.addEventListener('toggle', function () {
        shown.forEach(function (f) { if (d.contains(f.node) && !f.node.closest('details:not([open])')) draw(f); });
      });
    });
    var width = innerWidth;
    window.addEventListener('resize', function () {
      if (innerWidth === width) return;
      width = innerWidth;
      drawn().forEach(draw);
    });
    var folded = []; /* parts that were closed before printing, which opens all */
    ['beforeprint', 'afterprint'].forEach(function (kind) {
      window.addEventListener(kind, function () {
        printing = kind === 'beforeprint';
        if (printing) folded = folded.concat(all('details:not([open])'));
        folded.forEach(function (d) { d.open = printing; });
        (printing ? shown : drawn()).forEach(draw);
        if (!printing) folded = [];
      });
    });
    Promise.all(drawn().map(function (f) { return f.view.runAsync(); })).then(function () {
      return location.hash === '#figures' ? spell() : null;
    }).finally(function () { document.body.dataset.ready = '1'; });
  });
})();
