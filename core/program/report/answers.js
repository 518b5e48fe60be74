/* Figures of studies, load spectra and comparisons. The page has the numbers of each figure beside its caption; their member `sort`
 * names a function of this file, which describes the figure for figure.js. */
var answers = (function () {
  'use strict';
  var MOST_GROUPS = 8, NUMBER = /^([-+]?[\d.]+(?:e[-+]?\d+)?) *(.*)$/i;
  /* Colours of the verdicts of a map, from good to bad: distinct for the colour-blind (Okabe & Ito 2008), and light enough for a letter. */
  var VERDICTS = ['#009e73', '#56b4e9', '#cc79a7', '#f0f0f0', '#f0e442', '#ffffff', '#d55e00', '#999999'];

  function labelled(words, unit) { return unit ? words + ' (' + unit + ')' : words; }
  function convert(value, by) { return value * by.factor + by.offset; }
  function curve(style, name, colour, x, y, more) { return Object.assign({name: name, colour: colour, dash: 0, style: style, x: x, y: y}, more); }
  function curves(height, x, y, list, more) {
    return Object.assign({sort: 'curves', height: height, x: x, y: y, marks: [], curves: list}, more);
  }
  function values(map) { return Object.keys(map).map(function (key) { return map[key]; }); }

  /* Map of where a pipeline can be trusted. A cell is [class, line, value, limit, reason, note]; a good cell has only its class. */
  function side(axis) {
    var found = axis.values.map(function (text) { return NUMBER.exec(text); }), at = found.map(function (m, i) { return m ? parseFloat(m[1]) : axis.values[i]; });
    function share(value) {
      var first = at[0], last = at[at.length - 1];
      return axis.log ? Math.log(value / first) / Math.log(last / first) : (value - first) / (last - first);
    }
    return {label: labelled(axis.path.replace(/.*\./, '').replace(/_/g, ' '), found[0] ? found[0][2] : ''), at: at,
      place: function (value) { return share(value) * (at.length - 1) + 0.5; }};
  }
  function trust(of) {
    var sides = of.axes.map(side), x = sides[0], y = sides[1] || {label: '', at: ['']}, rows = y.at.length;
    return {sort: 'classes', x: x, y: y, classes: of.classes.map(function (kind, k) { return Object.assign({colour: VERDICTS[k]}, kind); }),
      height: rows < 5 ? 230 : rows < 8 ? 34 * rows + 70 : rows < 20 ? 22 * rows + 60 : 440, /* so that the name of the vertical axis fits */
      cells: of.cells.map(function (cell) { return cell[0]; }),
      reasons: of.cells.map(function (cell) {
        var value = cell[2] === null ? 'not known' : figures.text(cell[2] || 0);
        return [of.classes[cell[0]].name, cell[1] && cell[1] + ' = ' + value + ', limit ' + figures.text(cell[3]), cell[4], cell[5]]
          .filter(Boolean).join('; ');
      }),
      edges: of.boundaries.map(function (b) { /* a boundary, drawn across a cell where the halvings found it */
        var place = (sides[b[0]].place(b[3]) + sides[b[0]].place(b[4])) / 2, c = b[1], r = b[2];
        return b[0] === 0 ? [place, r, place, r + 1] : [c, place, c + 1, place];
      })};
  }

  /* Error against cost. The points of the front have numbers, which the table below names. Candidates whose labels begin with the same
   * words up to a comma share a colour. An error below the uncertainty of the reference is drawn at that uncertainty. */
  function front(of) {
    var absolute = of.output.absolute, factor = absolute ? 1 : 100, known = of.output.reference_error, groups = [], labels = [];
    var ranks = of.output.front.map(function (one) { return one.candidate; });
    of.candidates.forEach(function (c, i) {
      var cost = c.seconds && c.seconds.median, error = c.error && Math.max(c.error.error, known), label = c.label.split(',')[0];
      if (!(cost > 0 && error > 0)) return;
      if (labels.indexOf(label) < 0 && labels.length < MOST_GROUPS) {
        groups.push(curve('dots', label, labels.length, [], [], {dash: Math.floor(labels.length / 6), size: 46, bar: [], from: [], to: [], names: [], tags: []}));
        labels.push(label);
      }
      var at = labels.indexOf(label), g = groups[at < 0 ? MOST_GROUPS - 1 : at], rank = ranks.indexOf(i);
      g.x.push(cost);
      g.y.push(factor * error);
      g.bar.push(factor * known);
      g.from.push(c.seconds.min);
      g.to.push(c.seconds.max);
      g.names.push(c.label);
      g.tags.push(rank < 0 ? '' : String(rank + 1));
    });
    var line = curve('line', 'front', 'var(--soft)', of.output.front.map(function (one) { return one.seconds; }),
      of.output.front.map(function (one) { return factor * one.error; }), {dash: 2});
    var says = parseFloat((factor * known).toPrecision(2)) + (absolute ? '' : ' %');
    return curves(340, {label: 'cost (s on one core)', log: 1}, {label: (absolute ? 'error (SI)' : 'error (%)') + ', known to ' + says, log: 1},
      groups.concat(line), {room: 1});
  }

  /* The distribution of an output under uncertain inputs, with its percentiles. */
  function histogram(of) {
    var shares = of.histogram.shares, low = convert(of.histogram.from, of), width = (convert(of.histogram.to, of) - low) / shares.length;
    function edges(shift) { return shares.map(function (_, i) { return low + width * (i + shift); }); }
    return curves(280, {label: labelled(of.name, of.unit)}, {label: 'samples (%)', low: 0},
      [of.histogram.from === null ? curve('bars', '', 0, [], [], {from: [], to: []})
        : curve('bars', '', 0, edges(0.5), shares.map(function (s) { return 100 * s; }), {from: edges(0), to: edges(1)})],
      {marks: of.percentiles.filter(function (p) { return p.value !== null; }).map(function (p) {
        return [convert(p.value, of), parseFloat((100 * p.share).toPrecision(3)) + ' %'];
      })});
  }

  /* For each name, numbers in percent with error bars, one for each kind, beside each other. */
  function named(names, kinds, step, label, log) {
    return curves(260, {label: '', low: -0.5, high: names.length - 0.5}, {label: label, log: log}, kinds.map(function (kind, k) {
      return curve('dots', kind.name, k, names.map(function (_, i) { return i + step * (k - (kinds.length - 1) / 2); }),
        kind.of.map(function (e) { return e.value === null ? null : 100 * e.value; }),
        {size: 60, tags: names.map(function () { return ''; }), bar: kind.of.map(function (e) { return e.high > e.low ? 50 * (e.high - e.low) : 0; })});
    }), {names: names});
  }
  function shares(of) {
    var all = values(of.shares), untold = all.filter(function (s) { return s.untold; });
    var made = named(Object.keys(of.shares), [{name: 'alone', of: all.map(function (s) { return s.first; })},
      {name: 'with others', of: all.map(function (s) { return s.total; })}], 0.16, 'share of the variance (%)', 0);
    if (untold.length) made.note = untold[0].untold + ' ' + untold.length + ' of ' + all.length + ' alone.';
    return made;
  }
  function limits(of) {
    return named(Object.keys(of.outputs), ['numerical', 'model', 'input'].map(function (kind) {
      return {name: kind, of: values(of.outputs).map(function (one) { return {value: one[kind]}; })};
    }), 0.12, 'of the value (%)', 1);
  }

  /* The share of the time of a load spectrum in which an output is below a value. */
  function durations(of) {
    var steps = of.values.map(function (v, i) { return [v, of.times[i]]; }).filter(function (s) { return s[0] !== null; })
      .sort(function (a, b) { return a[0] - b[0]; });
    var whole = steps.reduce(function (sum, s) { return sum + s[1]; }, 0), time = 0, x = [], y = [];
    steps.forEach(function (s) {
      x.push(100 * time / whole, 100 * (time += s[1]) / whole);
      y.push(convert(s[0], of), convert(s[0], of));
    });
    return curves(260, {label: 'time below (%)'}, {label: labelled(of.name, of.unit)}, [curve('line', '', 0, x, y)]);
  }

  /* A series of several designs along the path of contact. Paths differ in length, so each is scaled to the points that all designs
   * have, such as SAP and tip. */
  function path(of) {
    var out = of.outputs[of.series[0].of], points = of.cases.map(function (one) {
      return one.marks.reduce(function (map, m) { map[m[1]] = m[0]; return map; }, {});
    });
    var shared = of.cases[0].marks.map(function (m) { return m[1]; }).filter(function (name) {
      return points.every(function (map) { return name in map; });
    });
    function scale(map, roll) {
      for (var k = 1; k < shared.length; k++) {
        var from = map[shared[k - 1]], to = map[shared[k]], slack = 1e-5 * Math.abs(to - from);
        if (Math.abs(roll - from) <= slack) return k - 1;
        if (Math.abs(roll - to) <= slack) return k;
        if (roll > from && roll < to) return k - 1 + (roll - from) / (to - from);
      }
      return null;
    }
    return curves(250, {label: 'path of contact, each scaled to its points', log: 0}, {label: labelled(out.label, out.unit), log: 0},
      of.series.map(function (s, k) {
        return curve('line', of.cases[k].name, k, Array.from(figures.unpack(s.x), function (roll) { return scale(points[k], roll); }),
          Array.from(figures.unpack(s.y), function (v) { return isFinite(v) ? convert(v, out) : null; }), {dash: k});
      }), {marks: shared.map(function (name, k) { return [k, name]; })});
  }

  return {trust: trust, front: front, histogram: histogram, shares: shares, limits: limits, durations: durations, path: path};
})();
