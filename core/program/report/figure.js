/* Translates the description of a figure for the plotting library. */
var figures = (function () {
  'use strict';
  var DASHES = [[], [7, 3], [2.5, 2.5], [9, 3, 2, 3]], COLOURS = 6;
  function text(value) { return typeof value === 'number' ? String(parseFloat(value.toPrecision(4))) : String(value); }
  function ink(i) { return typeof i === 'string' ? i : 'var(--c' + i % COLOURS + ')'; }
  function unpack(base64) { /* numbers are little-endian, like all machines that browsers run on */
    return new Float32Array(Uint8Array.from(atob(base64), function (c) { return c.charCodeAt(0); }).buffer);
  }
  function finite(list) { return list.filter(function (v) { return typeof v === 'number' && isFinite(v); }); }

  /* The range of an axis over the visible curves, with some margin at ends that the description does not give. */
  function domain(figure, axis) {
    var asked = figure[axis], values = [];
    figure.curves.forEach(function (curve) {
      if (curve.hidden || (axis !== 'x' && (curve.axis || 'y') !== axis)) return;
      if (axis === 'x' && curve.style === 'bars') values = values.concat(curve.from, curve.to);
      if (axis === 'y' && curve.style === 'bars') values.push(0);
      var own = curve[axis === 'x' ? 'x' : 'y'], other = curve[axis === 'x' ? 'y' : 'x'];
      own.forEach(function (v, i) {
        var bar = axis === 'y' && curve.bar ? curve.bar[i] : 0;
        if (v !== null && other[i] !== null) values.push(v - bar, v, v + bar);
      });
    });
    if (asked.log) values = values.filter(function (v) { return v > 0; });
    values = finite(values);
    var low = Infinity, high = -Infinity;
    values.forEach(function (v) { low = Math.min(low, v); high = Math.max(high, v); });
    if (!(low <= high)) { low = asked.log ? 0.1 : 0; high = 1; }
    if (axis !== 'x' || figure.room) {
      var part = figure.room ? 0.08 : 0.04, room = asked.log ? Math.pow(high / low, part) : part * (high - low);
      if (high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high)))
        room = asked.log ? 1.5 : 0.1 * Math.abs(high) || 1;
      low = asked.log ? low / room : low === 0 ? 0 : low - room;
      high = asked.log ? high * room : high + room;
    }
    if (asked.low !== undefined && (!asked.log || asked.low > 0)) low = asked.low;
    if (asked.high !== undefined) high = asked.high;
    return low < high ? [low, high] : [low - 0.5, low + 0.5];
  }
  function points(curve, figure) {
    if (curve.hidden) return [];
    return curve.y.map(function (y, i) {
      var x = curve.x[i], bar = curve.bar ? curve.bar[i] : 0, low = figure.y.log && y !== null ? Math.max(y - bar, y / 1e3) : y - bar;
      var good = y !== null && x !== null && (!figure.y.log || y > 0) && (!figure.x.log || x > 0);
      return {x: good ? x : 0.5, y: good ? y : 0.5, good: good, low: good ? low : 0.5, high: good ? y + bar : 0.5,
        from: curve.from ? curve.from[i] : x, to: curve.to ? curve.to[i] : x,
        tag: curve.tags ? curve.tags[i] : ''};
    });
  }
  /* Splits a name of more than `most` letters into two lines. */
  function folded(label, most) {
    var middle = label.indexOf(' ', label.length / 2 - 4);
    return label.length > most && middle > 0 ? [label.slice(0, middle), label.slice(middle + 1)] : label;
  }
  function axis(orient, scale, label, extra) {
    return Object.assign({orient: orient, scale: scale, title: folded(label, 30), grid: true, gridColor: 'var(--line)',
      domainColor: 'var(--soft)', tickColor: 'var(--soft)', labelColor: 'var(--soft)', titleColor: 'var(--ink)',
      labelFont: 'sans-serif', titleFont: 'sans-serif', titleFontWeight: 'normal', titleFontSize: 12.5, labelFontSize: 11,
      labelOverlap: 'greedy', titlePadding: 8, tickCount: {signal: scale === 'x' ? 'max(2, width / 70)' : '6'}}, extra);
  }
  function frame(figure, width, marks, more) {
    return Object.assign({width: width, height: figure.height || 250, padding: 5, autosize: {type: 'fit', contains: 'padding'},
      background: null, marks: marks}, more);
  }
  function clip(marks) {
    return {type: 'group', clip: true,
      encode: {update: {width: {signal: 'width'}, height: {signal: 'height'}}}, marks: marks};
  }
  function at(field, scale) { return {scale: scale || (field === 'x' || field === 'from' || field === 'to' ? 'x' : 'y'), field: field}; }
  function drawn(curve, k, several) {
    var colour = ink(curve.colour), from = {data: 'c' + k}, good = {signal: 'datum.good'}, marks = [];
    if (curve.style === 'bars')
      return [{type: 'rect', from: from, encode: {update: {x: at('from'), x2: at('to'), y: at('y'),
        y2: {scale: 'y', value: 0}, fill: {value: colour}, fillOpacity: {value: 0.7}}}}];
    if (curve.style === 'dots') {
      marks.push({type: 'rule', from: from, encode: {update: {x: at('x'), y: at('low'), y2: at('high'), stroke: {value: colour}, opacity: {value: 0.6}}}},
        {type: 'rule', from: from, encode: {update: {x: at('from'), x2: at('to'), y: at('y'), stroke: {value: colour}, opacity: {value: 0.6}}}},
        {type: 'symbol', from: from, encode: {update: {x: at('x'), y: at('y'), size: {value: curve.size || 28}, fill: {value: colour},
          opacity: {signal: 'datum.good ? 0.85 : 0'}}}},
        {type: 'text', from: from, encode: {update: {x: at('x'), y: at('y'), dx: {value: 7}, dy: {value: -7}, text: {field: 'tag'},
          fill: {value: 'var(--ink)'}, fontSize: {value: 11}}}});
      return marks;
    }
    if (curve.bar)
      marks.push({type: 'area', from: from, encode: {update: {x: at('x'), y: at('low'), y2: at('high'), defined: good,
        fill: {value: colour}, fillOpacity: {value: 0.22}}}});
    marks.push({type: 'line', from: from, encode: {update: {x: at('x'), y: at('y', curve.axis), defined: good, stroke: {value: colour},
      strokeWidth: {value: curve.wide || (several && !curve.dash ? 2.6 : 1.8)}, strokeDash: {value: curve.dash instanceof Array ? curve.dash : DASHES[curve.dash % DASHES.length]}, strokeJoin: {value: 'round'}}}});
    return marks;
  }
  function curveSpec(figure, width, legend) {
    var inside = [], marks = (figure.marks || []).map(function (m, i) { return {x: m[0], name: m[1], row: i % 2}; });
    figure.curves.forEach(function (curve, k) { inside = inside.concat(drawn(curve, k, figure.curves.length > 1)); });
    inside.unshift({type: 'rule', from: {data: 'marks'}, encode: {update: {x: at('x'), y: {value: 0}, y2: {signal: 'height'},
      stroke: {value: 'var(--soft)'}, strokeDash: {value: [1.5, 3]}}}});
    if (figure.limit) {
      var bound = {stroke: {value: '#d4351c'}, strokeWidth: {value: 1.5}, strokeDash: {value: [6, 3]}, x: {value: 0}, x2: {signal: 'width'}, y: {scale: 'y', value: figure.limit.at}};
      inside.push({type: 'rule', encode: {update: bound}}, {type: 'text', encode: {update: {x: {value: 4}, y: bound.y, dy: {value: -5},
        text: {value: figure.limit.name}, fontSize: {value: 11}, fill: {value: '#d4351c'}}}});
    }
    var names = {type: 'text', from: {data: 'marks'}, encode: {update: {x: at('x'), y: {signal: '-5 - 12 * datum.row'},
      text: {field: 'name'}, fontSize: {value: 11}, align: {signal: "datum.x >= xd[1] ? 'right' : datum.x <= xd[0] ? 'left' : 'center'"},
      fill: {value: 'var(--soft)'}, opacity: {signal: 'datum.x >= xd[0] - 1e-9 && datum.x <= xd[1] + 1e-9 ? 1 : 0'}}}};
    function scale(name, range) {
      return {name: name, type: figure[name].log ? 'log' : 'linear', range: range, domain: {signal: name + 'd'}, zero: false, nice: false};
    }
    function style(name) { /* a logarithmic axis has ticks at the powers of ten and, if these are few, at 2 and 5 times them */
      var step = figure[name].step, values = [];
      for (var i = 0; step && i <= Math.round((figure[name].high - figure[name].low) / step); i++)
        values.push(figure[name].low + i * step);
      if (!figure[name].log) return step ? {values: values, tickCount: values.length} : {};
      var d = figure[name + 'd'] || domain(figure, name);
      return {format: '.6~g', tickCount: Math.log10(d[1] / d[0]) > 2.5 ? Math.ceil(Math.log10(d[1] / d[0])) : 6};
    }
    var axes = [axis('bottom', 'x', figure.x.label, style('x')), axis('left', 'y', figure.y.label, style('y'))];
    if (figure.z) {
      axes.push(axis('right', 'z', figure.z.label, Object.assign({grid: false}, style('z'))));
    }
    if (figure.names) axes[0] = axis('bottom', 'x', '', {grid: false, values: figure.names.map(function (_, i) { return i; }), tickCount: figure.names.length,
      labelOverlap: false, labelAngle: width < 90 * figure.names.length ? -25 : 0, labelAlign: width < 90 * figure.names.length ? 'right' : 'center',
      labelLimit: 160, encode: {labels: {update: {text: {signal: 'xn[round(datum.value)]'}}}}});
    var shown = figure.curves.filter(function (c) { return c.name && !c.hidden; });
    var longest = Math.max.apply(null, shown.map(function (c) { return c.name.length; })); /* width in pixels: 40 for the line, 6 for each letter */
    return frame(figure, width, [clip(inside), names], {
      signals: [{name: 'xn', value: figure.names || []}, {name: 'xd', value: figure.xd || domain(figure, 'x')}, {name: 'yd', value: figure.yd || domain(figure, 'y')},
        {name: 'zd', value: figure.z ? domain(figure, 'z') : [0, 1]}],
      data: figure.curves.map(function (curve, k) { return {name: 'c' + k, values: points(curve, figure)}; })
        .concat([{name: 'marks', values: marks}]),
      scales: (figure.z ? [scale('z', 'height')] : []).concat([scale('x', 'width'), scale('y', 'height'),
        {name: 'key', type: 'ordinal', domain: shown.map(function (c) { return c.name; }),
          range: shown.map(function (c) { return ink(c.colour); })},
        {name: 'dash', type: 'ordinal', domain: shown.map(function (c) { return c.name; }),
          range: shown.map(function (c) { return c.dash instanceof Array ? c.dash : DASHES[(c.dash || 0) % DASHES.length]; })}]),
      axes: axes,
      legends: legend && shown.length ? [{stroke: 'key', strokeDash: 'dash', symbolType: 'stroke', symbolSize: 400, orient: 'top', direction: 'horizontal', offset: marks.length ? 30 : 8,
        columns: Math.max(1, Math.min(3, Math.floor(width / (40 + 6 * longest)))), labelColor: 'var(--ink)', labelLimit: 400}] : []});
  }

  /* Maps. The axes count rows and columns, and their labels show the values. */
  function share(value, scale) {
    if (scale.log) return Math.log(value / scale.low) / Math.log(scale.high / scale.low);
    return scale.high > scale.low ? (value - scale.low) / (scale.high - scale.low) : 0.5;
  }
  /* Draws a map with many cells as a picture. A cell has several pixels, so that its edges stay sharp. */
  function picture(figure) {
    var rows = figure.values.length, columns = figure.values[0].length, canvas = document.createElement('canvas'), size = 4;
    var pen = canvas.getContext('2d'), colour = vega.scheme('viridis');
    canvas.width = size * columns;
    canvas.height = size * rows;
    figure.values.forEach(function (row, r) {
      row.forEach(function (value, c) {
        if (value === null) return;
        pen.fillStyle = colour(share(value, figure.value));
        pen.fillRect(size * c, size * (rows - 1 - r), size, size);
      });
    });
    return canvas.toDataURL();
  }
  /* The values of a map's contours: round numbers within its scale. */
  function levels(scale) {
    var list = [], power = Math.pow(10, Math.floor(Math.log10(scale.log ? scale.low : (scale.high - scale.low) / 4 || 1)));
    if (scale.log) {
      for (; power < scale.high; power *= 10)
        (scale.high > 300 * scale.low ? [1] : [1, 2, 5]).forEach(function (m) { list.push(m * power); });
    } else {
      var step = [1, 2, 5, 10].map(function (m) { return m * power; }).filter(function (s) { return (scale.high - scale.low) / s <= 5; })[0];
      for (var k = Math.ceil(scale.low / step); step && k * step < scale.high; k++) list.push(k * step);
    }
    return list.map(function (v) { return parseFloat(v.toPrecision(6)); })
      .filter(function (v) { return v > scale.low && v < scale.high; });
  }
  /* The pieces of a contour, interpolated linearly between the centres of cells (on a logarithmic scale, in the logarithm). */
  function contour(figure, level) {
    var pieces = [], grid = figure.values;
    function above(value) { return figure.value.log ? Math.log(value / level) : value - level; }
    for (var r = 0; r + 1 < grid.length; r++)
      for (var c = 0; c + 1 < grid[r].length; c++) {
        var corners = [[c, r], [c + 1, r], [c + 1, r + 1], [c, r + 1]], ends = [];
        var heights = corners.map(function (at) { var v = grid[at[1]][at[0]]; return v === null ? NaN : above(v); });
        for (var k = 0; k < 4 && !heights.some(isNaN); k++) {
          var a = heights[k], b = heights[(k + 1) % 4], from = corners[k], to = corners[(k + 1) % 4], t = a / (a - b);
          if (a < 0 !== b < 0) ends.push([from[0] + t * (to[0] - from[0]) + 0.5, from[1] + t * (to[1] - from[1]) + 0.5]);
        }
        for (k = 0; k + 1 < ends.length; k += 2) pieces.push(ends[k].concat(ends[k + 1]));
      }
    return pieces;
  }
  function edgesOf(figure) {
    if (figure.sort !== 'map') return figure.edges.map(function (e) { return {0: e[0], 1: e[1], 2: e[2], 3: e[3], wide: 3}; });
    var list = [], marked = figure.mark === undefined ? [] : [figure.mark];
    levels(figure.value).filter(function (v) { return v !== figure.mark; }).concat(marked).forEach(function (level) {
      var pieces = contour(figure, level), middle = Math.floor(pieces.length / 2);
      pieces.forEach(function (e, i) {
        list.push({0: e[0], 1: e[1], 2: e[2], 3: e[3], wide: level === figure.mark ? 3.5 : 1.2,
          name: i === middle && pieces.length > 2 ? text(level) : ''});
      });
    });
    return list;
  }
  function mapSpec(figure, width) {
    var columns = figure.x.at.length, rows = figure.y.at.length, cells = [], marks = [], more = {legends: []};
    var box = {x: {scale: 'x', field: 'c'}, x2: {scale: 'x', signal: 'datum.c + 1'}, y: {scale: 'y', field: 'r'},
      y2: {scale: 'y', signal: 'datum.r + 1'}};
    var few = columns * rows <= 3000;
    if (figure.sort === 'map' && few) {
      figure.values.forEach(function (row, r) {
        row.forEach(function (value, c) {
          if (value !== null) cells.push({c: c, r: r, v: value});
        });
      });
      marks.push({type: 'rect', from: {data: 'cells'}, encode: {update: Object.assign({fill: {scale: 'v', field: 'v'},
        stroke: {scale: 'v', field: 'v'}, strokeWidth: {value: 0.5}}, box)}});
    } else if (figure.sort === 'map') {
      marks.push({type: 'image', encode: {update: {url: {value: figure.picture || (figure.picture = picture(figure))},
        x: {scale: 'x', value: 0}, x2: {scale: 'x', value: columns}, y: {scale: 'y', value: rows}, y2: {scale: 'y', value: 0},
        aspect: {value: false}}}});
    } else {
      figure.cells.forEach(function (k, i) {
        var kind = figure.classes[k];
        cells.push({c: i % columns, r: Math.floor(i / columns), fill: kind.colour, letter: kind.letter});
      });
      marks.push({type: 'rect', from: {data: 'cells'}, encode: {update: Object.assign({fill: {field: 'fill'},
        stroke: {value: 'var(--paper)'}, strokeWidth: {value: 1}}, box)}},
        {type: 'text', from: {data: 'cells'}, encode: {update: {x: {scale: 'x', signal: 'datum.c + 0.5'},
          y: {scale: 'y', signal: 'datum.r + 0.5'}, text: {field: 'letter'}, align: {value: 'center'}, baseline: {value: 'middle'},
          fill: {value: '#000'}, fontSize: {signal: 'max(6, min(13, 0.7 * width / (xd[1] - xd[0]), 0.7 * height / (yd[1] - yd[0])))'}}}});
    }
    if (figure.sort === 'map') {
      more.legends.push({fill: 'v', title: [(figure.value.label.match(/\(([^()]*)\)$/) || ['', ''])[1],
        (figure.value.log ? 'logarithmic' : 'linear') + ' scale'].filter(Boolean), titleFontSize: 11, orient: width < 500 ? 'bottom' : 'right',
        direction: width < 500 ? 'horizontal' : 'vertical', gradientLength: width < 500 ? 200 : 210, labelColor: 'var(--soft)',
        titleColor: 'var(--ink)', titleFontWeight: 'normal', format: '.6~g', tickCount: 5, titleOrient: 'top'});
    }
    var edge = {x: {scale: 'x', field: '0'}, y: {scale: 'y', field: '1'}, x2: {scale: 'x', field: '2'}, y2: {scale: 'y', field: '3'},
      strokeCap: {value: 'round'}};
    var name = {x: edge.x, y: edge.y, text: {field: 'name'}, align: {value: 'center'}, baseline: {value: 'middle'}, fontSize: {value: 11},
      fontWeight: {value: 'bold'}};
    if (figure.sort === 'map') /* a dark rim keeps the line visible on light cells */
      marks.push({type: 'rule', from: {data: 'edges'}, encode: {update: Object.assign({stroke: {value: '#000'}, opacity: {value: 0.35},
        strokeWidth: {signal: 'datum.wide + 2'}}, edge)}});
    marks.push({type: 'rule', from: {data: 'edges'}, encode: {update: Object.assign({stroke: {value: figure.sort === 'classes' ? '#000' : '#fff'},
      strokeWidth: {field: 'wide'}}, edge)}},
      {type: 'text', from: {data: 'edges'}, encode: {update: Object.assign({stroke: {value: '#000'}, strokeWidth: {value: 3}, opacity: {value: 0.6}}, name)}},
      {type: 'text', from: {data: 'edges'}, encode: {update: Object.assign({fill: {value: '#fff'}}, name)}});
    function middle(c, r) { return {x: {scale: 'x', value: c + 0.5}, y: {scale: 'y', value: r + 0.5}}; }
    /* Cells that miss a limit are crossed out; those that meet it only within their error bar are framed. */
    (figure.standing || []).forEach(function (row, r) {
      row.split('').forEach(function (kind, c) {
        var half = kind === '2' ? 0.5 : 0.42, cell = {stroke: {value: kind === '2' ? '#e2330f' : '#ffb000'}, strokeWidth: {value: 1.6},
          x: {scale: 'x', value: c + 0.5 - half}, x2: {scale: 'x', value: c + 0.5 + half}, y: {scale: 'y', value: r + 0.5 - half}, y2: {scale: 'y', value: r + 0.5 + half}};
        if (kind !== '0') marks.push({type: kind === '2' ? 'rule' : 'rect', encode: {update: cell}});
      });
    });
    if (figure.best)
      marks.push({type: 'symbol', encode: {update: Object.assign({shape: {value: 'circle'}, size: {value: 170}, fill: {value: '#fff'}, stroke: {value: '#000'},
        strokeWidth: {value: 1.5}}, middle(figure.best[0], figure.best[1]))}},
      {type: 'text', encode: {update: Object.assign({text: {value: '\u2605'}, fill: {value: '#000'}, fontSize: {value: 12}, align: {value: 'center'},
        baseline: {value: 'middle'}}, middle(figure.best[0], figure.best[1]))}});
    function ranks(count, most) {
      var list = [], step = Math.ceil(count / most);
      for (var i = 0; i < count; i += step) list.push(i + 0.5);
      return list;
    }
    return frame(figure, width, [clip(marks)], Object.assign({
      signals: [{name: 'xd', value: figure.xd || [0, columns]}, {name: 'yd', value: figure.yd || [0, rows]},
        {name: 'xl', value: figure.x.at.map(text)}, {name: 'yl', value: figure.y.at.map(text)}],
      data: [{name: 'cells', values: cells}, {name: 'edges', values: edgesOf(figure)}],
      scales: [{name: 'x', type: 'linear', range: 'width', domain: {signal: 'xd'}, zero: false, nice: false},
        {name: 'y', type: 'linear', range: 'height', domain: {signal: 'yd'}, zero: false, nice: false},
        {name: 'v', type: figure.value && figure.value.log ? 'log' : 'linear', range: {scheme: 'viridis'},
          domain: figure.value ? [figure.value.low, figure.value.high] : [0, 1], zero: false}],
      axes: [axis('bottom', 'x', figure.x.label, {grid: false, tickCount: columns, values: ranks(columns, Math.max(2, width / 75)),
        encode: {labels: {update: {text: {signal: 'xl[floor(datum.value)]'}}}}}),
      axis('left', 'y', figure.y.label, {title: folded(figure.y.label, ((figure.height || 250) - 130) / 7), grid: false, tickCount: rows, values: ranks(rows, 12),
        encode: {labels: {update: {text: {signal: 'yl[floor(datum.value)]'}}}}})]}, more));
  }
  /* The meaning of a map's letters, for a figure without a list below it. */
  function counts(figure) {
    return figure.classes.map(function (kind, k) {
      var count = figure.cells.filter(function (c) { return c === k; }).length;
      return count ? kind.letter + '  ' + count + ' ' + kind.name + ': ' + kind.text : '';
    }).filter(Boolean);
  }
  function spec(figure, width, legend) {
    var made = figure.sort === 'curves' ? curveSpec(figure, width, legend) : mapSpec(figure, width);
    if (figure.place) made.autosize = {type: 'pad'};
    var heading = figure.heading || figure.title;
    if (legend && heading) made.title = {text: heading, anchor: 'start', fontSize: 13};
    if (legend && figure.sort === 'classes') made.title = {text: [heading || ''].concat(counts(figure)), orient: 'bottom', anchor: 'start', fontSize: 12, fontWeight: 'normal'};
    return made;
  }
  function view(figure, width, legend) {
    return new vega.View(vega.parse(spec(figure, width, legend), null, {ast: true}), {expr: vega.interpreter, renderer: 'svg'});
  }

  /* A figure as SVG that needs no style sheet, in the light colours. */
  function standalone(figure) {
    return view(figure, figure.width || 760, true).toSVG().then(function (svg) {
      var style = getComputedStyle(document.getElementById('light'));
      return svg.replace(/var\((--\w+)\)/g, function (_, name) { return style.getPropertyValue(name).trim(); })
        .replace(/ (d|transform)="[^"]*"/g, function (place) { /* rounds coordinates to a tenth of a pixel */
          return place.replace(/-?\d+\.\d{2,}/g, function (n) { return String(Number(Number(n).toFixed(1))); });
        });
    });
  }
  return {view: view, standalone: standalone, points: points, text: text, ink: ink, finite: finite, unpack: unpack, dashes: DASHES.length};
})();
