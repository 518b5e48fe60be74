(function () {
  'use strict';
  var errors = [];
  window.addEventListener('error', function (e) { errors.push(e.message); });
  function all(selector, within) {
    return Array.prototype.slice.call((within || document).querySelectorAll(selector));
  }
  function range(plot, axis) { return plot.dataset[axis].split(' ').map(Number); }
  function text(value) { return String(parseFloat(value.toPrecision(4))); }

  /* A figure with its light colours, fit to stand alone. */
  function standalone(svg) {
    var copy = svg.cloneNode(true), style = document.createElementNS(svg.namespaceURI, 'style');
    var size = svg.viewBox.baseVal;
    style.textContent = document.getElementById('figure-style').textContent;
    copy.insertBefore(style, copy.firstChild);
    copy.setAttribute('width', size.width);
    copy.setAttribute('height', size.height);
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + new XMLSerializer().serializeToString(copy);
  }
  all('button.save').forEach(function (button) {
    button.addEventListener('click', function () {
      var svg = button.closest('figure').querySelector('svg'), link = document.createElement('a');
      link.href = URL.createObjectURL(new Blob([standalone(svg)], {type: 'image/svg+xml'}));
      link.download = button.dataset.name + '.svg';
      link.click();
      setTimeout(function () { URL.revokeObjectURL(link.href); }, 1000);
    });
  });

  /* The values of the curves where the pointer is. */
  var tip = document.createElement('div');
  tip.id = 'tip';
  tip.hidden = true;
  document.body.appendChild(tip);
  function points(path) {
    if (path.drawn !== path.getAttribute('d')) {
      path.drawn = path.getAttribute('d');
      path.places = path.drawn.split(/[ML]/).slice(1).map(function (pair) {
        return pair.split(' ').map(Number);
      });
    }
    return path.places;
  }
  function nearest(path, x) {
    var best = null;
    points(path).forEach(function (p) {
      if (!best || Math.abs(p[0] - x) < Math.abs(best[0] - x)) best = p;
    });
    return best && Math.abs(best[0] - x) < 12 ? best : null;
  }
  function show(svg, plot, event) {
    var box = svg.getBoundingClientRect(), view = svg.viewBox.baseVal;
    var x = (event.clientX - box.left) * view.width / box.width;
    var h = range(plot, 'x'), v = range(plot, 'y'), lines = [];
    if (x < h[2] || x > h[3]) { tip.hidden = true; return; }
    all('.curve', plot).forEach(function (path) {
      var p = nearest(path, x);
      if (p) lines.push((path.dataset.label ? path.dataset.label + ': ' : '') +
        text(v[0] + (p[1] - v[2]) / (v[3] - v[2]) * (v[1] - v[0])));
    });
    var share = (x - h[2]) / (h[3] - h[2]); /* h[4]: in decades */
    tip.textContent = 'x = ' +
      text(h[4] ? h[0] * Math.pow(h[1] / h[0], share) : h[0] + share * (h[1] - h[0])) + '\n' +
      lines.join('\n');
    tip.hidden = lines.length === 0;
    tip.style.left = Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 8) + 'px';
    tip.style.top = event.clientY + 14 + 'px';
  }
  all('svg.figure').forEach(function (svg) {
    var plot = svg.querySelector('.plot');
    if (!plot) return;
    svg.addEventListener('mousemove', function (event) { show(svg, plot, event); });
    svg.addEventListener('mouseleave', function () { tip.hidden = true; });
  });

  /* Snapshots: the slider names an instant of the first stage; others show their nearest one. */
  function floats(base64) {
    var bytes = Uint8Array.from(atob(base64), function (c) { return c.charCodeAt(0); });
    var view = new DataView(bytes.buffer), out = new Float32Array(bytes.length / 4);
    for (var i = 0; i < out.length; i++) out[i] = view.getFloat32(4 * i, true);
    return out;
  }
  function closest(list, value) {
    var best = 0;
    for (var i = 1; i < list.length; i++)
      if (Math.abs(list[i] - value) < Math.abs(list[best] - value)) best = i;
    return best;
  }
  all('.snapshots').forEach(function (section) {
    var data = JSON.parse(section.querySelector('.frames').textContent), timer = null;
    var slider = section.querySelector('input'), play = section.querySelector('.play');
    data.stages.forEach(function (stage) {
      ['at', 'x', 'p', 'h'].forEach(function (key) { stage[key] = floats(stage[key]); });
    });
    function path(plot, stage, field, frame) {
      var h = range(plot, 'x'), v = range(plot, 'y'), d = [];
      for (var i = 0; i < stage.cells; i++) {
        var x = h[2] + (stage.x[i] - h[0]) / (h[1] - h[0]) * (h[3] - h[2]);
        var y = v[2] + (field[frame * stage.cells + i] - v[0]) / (v[1] - v[0]) * (v[3] - v[2]);
        d.push(x.toFixed(1) + ' ' + Math.max(y, -1e3).toFixed(1));
      }
      return 'M' + d.join('L');
    }
    function draw() {
      var at = data.stages[0].at[slider.value];
      data.stages.forEach(function (stage, k) {
        var frame = k ? closest(stage.at, at) : Number(slider.value);
        ['p', 'h'].forEach(function (key) {
          var curve = section.querySelector('[data-live="' + key + k + '"]');
          curve.setAttribute('d', path(curve.parentNode, stage, stage[key], frame));
        });
      });
      section.querySelector('output').textContent = data.unit ?
        (data.unit === 'deg' ? 'roll angle ' : 'time ') + text(at) + ' ' + data.unit :
        'instant ' + text(at);
    }
    function stop() {
      clearInterval(timer);
      timer = null;
      play.textContent = 'play';
      play.setAttribute('aria-pressed', 'false');
    }
    slider.addEventListener('input', draw);
    play.addEventListener('click', function () {
      if (timer) { stop(); return; }
      play.textContent = 'pause';
      play.setAttribute('aria-pressed', 'true');
      timer = setInterval(function () {
        slider.value = (Number(slider.value) + 1) % (Number(slider.max) + 1);
        draw();
      }, 60);
    });
    draw();
  });

  /* #check: the page tries itself; a test reads what it found from the body. */
  function check() {
    all('.snapshots').forEach(function (section) {
      var slider = section.querySelector('input'), seen = {}, play = section.querySelector('.play');
      for (slider.value = 0; ; slider.value = Number(slider.value) + 1) {
        slider.dispatchEvent(new Event('input'));
        seen[section.querySelector('[data-live]').getAttribute('d')] = true;
        if (slider.value === slider.max) break;
      }
      if (Object.keys(seen).length < 2) errors.push('the slider changes nothing');
      play.click();
      if (play.textContent !== 'pause') errors.push('play does not play');
      play.click();
    });
    all('svg.figure').forEach(function (svg) {
      var saved = new DOMParser().parseFromString(standalone(svg), 'image/svg+xml');
      if (saved.querySelector('parsererror')) errors.push('a saved figure is broken');
      if (/NaN|Infinity/.test(svg.innerHTML)) errors.push('a figure has no number');
      var box = svg.getBoundingClientRect();
      svg.dispatchEvent(new MouseEvent('mousemove',
        {clientX: box.left + box.width / 2, clientY: box.top + box.height / 2}));
    });
  }
  window.addEventListener('load', function () {
    setTimeout(function () {
      var time = performance.timing;
      document.body.dataset.load = time.loadEventEnd - time.navigationStart;
      if (location.hash === '#check') {
        try { check(); } catch (e) { errors.push(String(e)); }
        document.body.dataset.figures = all('svg.figure').length;
        document.body.dataset.errors = errors.join('; ');
      }
      document.body.dataset.ready = '1';
    }, 0);
  });
})();
