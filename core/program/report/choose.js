/* Chooses which of the page's numbers are drawn, and describes each figure for figure.js.
 * sections(data) returns a list of {at, title, note, folded, figures}: `at` names the element of the page. */
var choice = (function () {
  'use strict';
  /* Title of a figure, and the names of the outputs that it shows. Stages with the same output are compared in it. */
  var PATH = [
    ['Film thickness', 'h_min', 'h_central'],
    ['Pressure', 'p_max', 'hertz_pressure'],
    ['Load per width', 'load_per_width'],
    ['Tooth force', 'tooth_force'],
    ['Load share', 'load_share'],
    ['Surface speeds', 'speed_1', 'speed_2', 'entrainment_speed', 'sliding_speed'],
    ['Friction coefficient', 'friction_coefficient'],
    ['Power loss', 'power_loss'],
    ['Contact temperature', 'contact_temperature'],
    ['Flash temperature', 'flash_temperature'],
    ['Film over roughness', 'lambda_ratio'],
    ['Asperities', 'asperity_load_share'],
    ['Separation of the flanks', 'gap']
  ];
  var CYCLE = [
    ['Transmission error, alternating part', 'dte', 'loaded_transmission_error'],
    ['Mesh force', 'mesh_force'],
    ['Sliding loss', 'mesh_power_loss'],
    ['Mesh stiffness', 'stiffness']
  ];
  var SURFACES = [['Roughness of gear 1', 'height_1'], ['Roughness of gear 2', 'height_2']];
  var MOST = {lines: 8, maps: 6, inputs: 12, others: 30, ranked: 2000, bins: 30, periods: 6, stages: 3};

  /* Numbers. */
  function scaled(list, by, whole) { /* whole: a difference has no offset */
    return Array.prototype.map.call(list, function (v) {
      return v !== null && isFinite(v) ? parseFloat((v * by.factor + (whole === false ? 0 : by.offset)).toPrecision(7)) : null;
    });
  }
  function known(list) { return list.filter(function (v) { return v !== null && isFinite(v); }); }
  function least(list) { return known(list).reduce(function (a, b) { return Math.min(a, b); }, Infinity); }
  function most(list) { return known(list).reduce(function (a, b) { return Math.max(a, b); }, -Infinity); }
  function percentile(sorted, percent) {
    var at = percent / 100 * (sorted.length - 1), low = Math.floor(at);
    return low + 1 < sorted.length ? sorted[low] + (at - low) * (sorted[low + 1] - sorted[low]) : sorted[sorted.length - 1];
  }
  function labelled(words, unit) { return unit ? words + ' (' + unit + ')' : words; }
  /* Shortens a long curve to the first, lowest, highest and last of each group of points and the start of each gap, so that no peak and
   * no gap is lost; of many dots, keeps some. */
  function thinned(curve, most) {
    var y = curve.y, count = y.length, kept = [], dots = curve.style === 'dots', run = Math.ceil(count / most) * (dots ? 1 : 4);
    if (count <= most) return curve;
    for (var i = 0; i < count; i += run) {
      var low = i, high = i, end = Math.min(i + run, count);
      for (var k = i; k < end; k++) {
        if (y[low] === null || (y[k] !== null && y[k] < y[low])) low = k;
        if (y[high] === null || (y[k] !== null && y[k] > y[high])) high = k;
      }
      for (k = i; k < end; k++)
        if (k === i || (!dots && (k === low || k === high || k === end - 1 || (y[k] === null && y[k - 1] !== null)))) kept.push(k);
    }
    return Object.assign(curve, {x: kept.map(function (k) { return curve.x[k]; }), y: kept.map(function (k) { return curve.y[k]; })});
  }
  function label(of) { return labelled(of.label, of.unit); }
  function figure(title, more) { return Object.assign({sort: 'curves', title: title, class: '', marks: [], curves: []}, more); }
  function line(name, colour, dash, x, y) { return {name: name, colour: colour, dash: dash, style: 'line', x: x, y: y}; }
  /* Whether an axis is logarithmic: the values are positive and span more than a factor of 30. If they span
   * more than 1e4, the small ones count as 0, and the axis is linear. */
  function wide(low, high) { return low > 0 && high > 30 * low && high < 1e4 * low; }
  function spread(curves) { /* curves have the colours of their stages; if there is only one stage, each curve has its own */
    if (curves.every(function (c) { return c.colour === curves[0].colour; }))
      curves.forEach(function (c, k) { c.colour = k; });
  }

  /* Series: along the path of contact, over the mesh cycle, and others. */
  function seriesOf(data) {
    var by = {}, axes = {};
    data.series.forEach(function (s) {
      (by[s.of] = by[s.of] || []).push(s);
      axes[s.along] = true;
    });
    function anyOf(name) {
      return data.series.some(function (s) { return data.outputs[s.of].output === name; });
    }
    /* Leaves out the gap of a contact if a motion has a gap too: the first is 0 as soon as damping loads the flanks again. */
    function isOtherGap(s) {
      return data.outputs[s.of].output === 'gap' && s.dim === 't' && data.series.some(function (other) {
        return data.outputs[other.of].output === 'gap' && other.dim !== 't';
      });
    }
    function withoutMean(x, y) { /* over x, by the trapezoidal rule */
      var sum = 0, length = 0;
      for (var i = 1; i < x.length; i++) {
        sum += 0.5 * (x[i] - x[i - 1]) * (y[i] + y[i - 1]);
        length += x[i] - x[i - 1];
      }
      return length > 0 ? y.map(function (v) { return v === null ? null : v - sum / length; }) : y;
    }
    function left(stage, output) { return (by[stage + '.' + output] || []).filter(function (s) { return !s.drawn; }); }
    function begin(title) { return {figure: figure(title), low: Infinity, high: -Infinity, share: false}; }
    function add(f, s, colour, several, alternating) {
      var of = data.outputs[s.of], along = s.along && data.outputs[s.along], x = figures.unpack(s.x), y = figures.unpack(s.y);
      if (f.of && (f.of.si !== of.si || (f.along ? f.along.si : '') !== (along ? along.si : ''))) return; /* it gets a figure of its own below */
      s.drawn = true;
      if (!f.of) {
        f.of = of;
        f.along = along;
        f.figure.x = {label: along ? label(along) : s.dim.replace(/_/g, ' '), log: 0};
        f.figure.y = {label: label(of), log: 0};
      }
      x = scaled(x, f.along || {factor: 1, offset: 0});
      y = scaled(y, f.of);
      var same = !data.study && f.figure.curves.filter(function (c) {
        return c.all.length === y.length && c.all.every(function (v, i) { return v === y[i]; });
      })[0];
      if (same) {
        same.name = same.name.replace(/^[^:]*/, '$&, ' + of.stage);
        return;
      }
      var name = several ? of.stage + ': ' + of.label : of.stage;
      if (data.study && data.cases[s.case].name) name += ' (' + data.cases[s.case].name + ')';
      var curve = line(name, colour, f.figure.curves.length, x, alternating ? withoutMean(x, y) : y);
      Object.defineProperty(curve, 'all', {value: y});
      if (s.bar) curve.bar = scaled(figures.unpack(s.bar), {factor: Math.abs(f.of.factor)}, false);
      /* extremes of a share, such as a friction coefficient, leave out points without load */
      var ends = s.ends ? scaled(s.ends, f.of) : [least(curve.y), most(curve.y)];
      f.share = f.share || !!s.ends;
      f.low = Math.min(f.low, ends[0]);
      f.high = Math.max(f.high, ends[1]);
      f.figure.curves.push(curve);
    }
    function end(f) {
      var made = f.figure, margin = 0.1 * (f.high - f.low);
      if (made.curves.every(function (c) { return known(c.y).every(function (v) { return v === 0; }); })) return [];
      spread(made.curves);
      if (f.along && f.along.si === 'rad')
        made.marks = data.cases[0].marks.map(function (m) { return [scaled([m[0]], f.along)[0], m[1]]; });
      if (f.share) Object.assign(made.y, {low: f.low - margin, high: f.high + margin});
      else if (wide(f.low, f.high)) made.y.log = 1;
      return [made];
    }
    function group(names) {
      var outputs = names.slice(1), several = outputs.filter(anyOf).length > 1, f = begin(names[0]), used = 0;
      data.stages.forEach(function (stage) {
        var any = false;
        outputs.forEach(function (output) {
          var own = left(stage, output);
          if (own.length && isOtherGap(own[0])) own.forEach(function (s) { s.drawn = true; });
          if (!own.length || own[0].drawn) return;
          own.forEach(function (s) { add(f, s, data.study ? s.case : used, several, /alternating/.test(names[0])); });
          any = true;
        });
        used += any ? 1 : 0;
      });
      if (several && f.of) f.figure.y.label = labelled(names[0].toLowerCase(), f.of.unit); /* the legend names the outputs */
      return f.of ? end(f) : [];
    }
    function all(groups) { return groups.reduce(function (list, one) { return list.concat(group(one)); }, []); }
    /* The series that no figure above shows: those along the given axis, or all. */
    function others(along) {
      var list = [];
      data.series.forEach(function (s) {
        var of = data.outputs[s.of], used = 0, f = begin(of.label);
        if (s.drawn || (along && !(of.asked && along(s))) || list.length === MOST.others || axes[s.of] || of.si === 'rad' || of.si === 's' || of.output === s.dim || /^atlas_/.test(of.output)) return;
        data.stages.forEach(function (stage) {
          var own = left(stage, of.output);
          own.forEach(function (one) { add(f, one, data.study ? one.case : used, false); });
          used += own.length ? 1 : 0;
        });
        list = list.concat(end(f));
      });
      return list;
    }
    var note = data.study ? data.cases.length + ' of the ' + data.well + ' successful cases that have series.' : '';
    function onPath(s) { return s.along && data.outputs[s.along].si === 'rad'; }
    function inCycle(s) { return s.dim === 'phase'; }
    var path = all(PATH), cycle = all(CYCLE), surfaces = all(SURFACES);
    return [{title: 'Along the path of contact', note: note, figures: path.concat(others(onPath))},
      {title: 'Over the mesh cycle', note: note, figures: cycle.concat(others(inCycle))},
      {title: 'Surfaces', note: note, figures: surfaces},
      {title: 'Other series', folded: true, figures: others()}];
  }

  /* Every periodic motion that a stage found, over the mesh frequency. */
  function atlases(data) {
    var list = [];
    function scalar(name) {
      var found = Object.keys(data.scalars).filter(function (key) { return data.outputs[key].output === name; })[0];
      return found === undefined ? NaN : figures.unpack(data.scalars[found])[0];
    }
    data.stages.forEach(function (stage) {
      function numbers(name) {
        var s = data.series.filter(function (one) { return one.of === stage + '.' + name; })[0];
        return s && figures.unpack(s.y);
      }
      var f = numbers('atlas_frequency'), rms = numbers('atlas_rms'), stable = numbers('atlas_stable'), branch = numbers('atlas_branch');
      if (data.study || !f || !rms || f.length < 2 || f.length !== rms.length) return;
      var size = data.outputs[stage + '.atlas_rms'], made = figure(stage + ': all periodic motions',
        {class: 'broad', x: {label: 'mesh frequency (Hz)', log: 0}, y: {label: labelled('transmission error, rms', size.unit), log: 0, low: 0}});
      function branchOf(i) { return branch ? branch[i] : 0; }
      function periodOf(i) { return branchOf(i) >= 1000 && branchOf(i) < 1e6 ? Math.floor(branchOf(i) / 1000) : 1; }
      function isStable(i) { return !stable || stable[i] > 0; }
      /* The stable and the unstable part of a branch share the point where stability changes. */
      function part(period, wanted) {
        var x = [], y = [];
        for (var i = 0; i < f.length; i++) {
          var same = i > 0 && branchOf(i - 1) === branchOf(i);
          var kept = periodOf(i) === period && (isStable(i) === wanted || (same && isStable(i - 1) === wanted));
          if (!same || !kept) { x.push(null); y.push(null); }
          if (kept) { x.push(f[i]); y.push(rms[i]); }
        }
        if (known(x).length)
          made.curves.push(line('period of ' + period + ' mesh cycle' + (period > 1 ? 's' : '') + ', ' + (wanted ? 'stable' : 'unstable'), period - 1,
            wanted ? 0 : 2, scaled(x, {factor: 1, offset: 0}), scaled(y, size)));
      }
      for (var period = 1; period <= MOST.periods; period++) { part(period, true); part(period, false); }
      var backlash = scalar('backlash'), here = scalar('mesh_frequency');
      if (backlash > 0 && most(Array.from(rms)) > backlash) { /* contact loss with impacts on both flanks */
        made.y.high = scaled([backlash], size)[0];
        made.note = 'Motions larger than the backlash are cut off.';
      }
      if (isFinite(here)) made.marks.push([here, 'this run']);
      list.push(made);
    });
    return [{title: 'Transmission error against speed', figures: list}];
  }

  /* Scalars over what a study varies. */
  function overCases(data) {
    var count = data.lengths.reduce(function (a, b) { return a * b; }, 1), dimensions = data.lengths.length;
    function stride(d) { return data.lengths.slice(d + 1).reduce(function (a, b) { return a * b; }, 1); }
    function point(c, d) { return Math.floor(c / stride(d)) % data.lengths[d]; }
    /* The case of combination k of all dimensions except those in `without`. */
    function caseOf(k, without) {
      var c = 0;
      for (var d = dimensions - 1; d >= 0; d--) {
        if (without.indexOf(d) >= 0) continue;
        c += k % data.lengths[d] * stride(d);
        k = Math.floor(k / data.lengths[d]);
      }
      return c;
    }
    function nameOf(c, without) {
      return data.axes.filter(function (a) { return without.indexOf(a.dimension) < 0 && data.lengths[a.dimension] > 1; })
        .map(function (a) { return a.named[point(c, a.dimension)]; }).filter(Boolean).join(', ');
    }
    function inOrder(values) { /* a line over values in another order would run to and fro */
      function pairs(test) { return values.every(function (v, i) { return i === 0 || test(v, values[i - 1]); }); }
      return pairs(function (a, b) { return a >= b; }) || pairs(function (a, b) { return a <= b; });
    }
    /* The numeric axis with the most points, except those of the dimension `other`. */
    function mainAxis(other) {
      return data.axes.reduce(function (best, a) {
        var points = data.lengths[a.dimension];
        return a.typed && a.dimension !== other && points > (best ? data.lengths[best.dimension] : 1) && inOrder(a.values) ? a : best;
      }, null);
    }
    function numeric(a) { return a.values.every(function (v) { return v !== null; }); }
    function geometric(v) { /* whether the points are spaced as by `spacing: log`, over a factor of at least five */
      return v.length > 2 && v[0] > 0 && Math.abs(Math.log(v[v.length - 1] / v[0])) > Math.log(5) &&
        v.every(function (one, i) { return i < 2 || Math.abs(one / v[i - 1] / (v[1] / v[0]) - 1) < 1e-6; });
    }
    function firsts(number, all, made) {
      if (number > all) made.note = 'The first ' + all + ' of ' + number + ' combinations.';
      return made;
    }
    function lines(s, axis) {
      var points = data.lengths[axis.dimension], number = count / points, step = stride(axis.dimension), x = scaled(axis.values, axis);
      var made = figure(s.title, {x: {label: label(axis), log: geometric(axis.values) ? 1 : 0}, y: {label: label(s.of), log: 0}});
      if (s.of.limit && s.of.limit.at !== null) made.limit = {at: scaled([s.of.limit.at], s.of)[0], name: s.of.limit.name};
      for (var k = 0; k < number && k < MOST.lines; k++) {
        var first = caseOf(k, [axis.dimension]), name = nameOf(first, [axis.dimension]), y = [];
        for (var i = 0; i < points; i++) y.push(s.values[first + i * step]);
        if (!known(y).length) continue;
        /* the chains up and down are one curve if both found the same motion */
        var same = made.curves.filter(function (c) {
          var room = 1e-3 * (most(c.y) - least(c.y));
          return c.y.every(function (v, i) { return v !== null && y[i] !== null && Math.abs(v - y[i]) <= room; });
        })[0];
        if (same) same.name += ' and ' + name;
        else made.curves.push(line(name, made.curves.length, k, x, y));
      }
      made.curves.forEach(function (c) { thinned(c, 2800); });
      if (wide(least(s.values), most(s.values))) made.y.log = 1;
      return [firsts(number, MOST.lines, made)];
    }
    function map(s, x, y, first) {
      var made = {sort: 'map', height: 300, title: s.title, x: {label: label(x), at: scaled(x.values, x)}, y: {label: label(y), at: scaled(y.values, y)}};
      var low = least(s.values), high = most(s.values), rest = nameOf(first, [x.dimension, y.dimension]), best = null;
      if (rest) made.title += ' (' + rest + ')';
      made.value = {label: label(s.of), log: low > 0 && high > 30 * low ? 1 : 0, low: low, high: high};
      made.values = [];
      made.standing = [];
      y.values.forEach(function (_, r) {
        var cells = x.values.map(function (_, c) { return first + c * stride(x.dimension) + r * stride(y.dimension); });
        made.values.push(cells.map(function (c) { return s.values[c]; }));
        made.standing.push(cells.map(function (c) { return data.standing[c]; }).join(''));
        cells.forEach(function (c, k) { /* the best case must not miss a limit */
          if (s.values[c] !== null && data.standing[c] !== '2' && (best === null || s.of.sense * (s.values[c] - best) > 0)) {
            best = s.values[c];
            if (s.of.sense) made.best = [k, r];
          }
        });
      });
      if (s.of.limit && s.of.limit.at !== null) made.mark = scaled([s.of.limit.at], s.of)[0];
      return made;
    }
    function maps(s, x, y) {
      var number = count / data.lengths[x.dimension] / data.lengths[y.dimension], list = [];
      for (var k = 0; k < number && k < MOST.maps; k++) list.push(map(s, x, y, caseOf(k, [x.dimension, y.dimension])));
      firsts(number, MOST.maps, list[list.length - 1]);
      return list;
    }
    /* Dots, for cases without an order, such as those that differ in words. */
    function dots(title, s, xLabel, x) {
      return figure(title, {room: 1, x: {label: xLabel, log: 0}, y: {label: label(s.of), log: 0},
        curves: [thinned(Object.assign(line('', 0, 0, x, s.values), {style: 'dots'}), 3000)]});
    }
    function bars(x, y, width) {
      return {name: '', colour: 0, dash: 0, style: 'bars', x: x, y: y, from: x.map(function (v) { return v - width / 2; }), to: x.map(function (v) { return v + width / 2; })};
    }
    function histogram(s) {
      var sorted = known(s.values).sort(function (a, b) { return a - b; }), low = sorted[0];
      var number = sorted.length < 2 ? 1 : Math.min(Math.ceil(Math.sqrt(sorted.length)) + 1, MOST.bins), width = (sorted[sorted.length - 1] - low) / number;
      var x = [], y = [];
      if (!(width > 0)) return [];
      for (var i = 0; i < number; i++) { x.push(low + (i + 0.5) * width); y.push(0); }
      sorted.forEach(function (v) { y[Math.min(Math.floor((v - low) / width), number - 1)]++; });
      return [figure(s.title + ': distribution', {x: {label: label(s.of), log: 0}, y: {label: 'cases', log: 0, low: 0}, curves: [bars(x, y, width)],
        marks: [5, 50, 95].map(function (p) { return [percentile(sorted, p), p + ' %']; })})];
    }
    function ranks(values) { /* equal values share their ranks */
      var order = values.map(function (_, i) { return i; }).sort(function (a, b) { return values[a] - values[b]; }), list = [];
      for (var i = 0, end; i < order.length; i = end) {
        for (end = i; end < order.length && values[order[end]] === values[order[i]];) end++;
        for (var k = i; k < end; k++) list[order[k]] = (i + end) / 2;
      }
      return list;
    }
    function correlation(x, y) {
      function mean(list) { return list.reduce(function (a, b) { return a + b; }, 0) / list.length; }
      var mx = mean(x), my = mean(y), xx = 0, yy = 0, xy = 0;
      x.forEach(function (v, i) {
        xx += (v - mx) * (v - mx);
        yy += (y[i] - my) * (y[i] - my);
        xy += (v - mx) * (y[i] - my);
      });
      return xx > 0 && yy > 0 ? xy / Math.sqrt(xx * yy) : 0;
    }
    function sample(s) {
      var inputs = data.axes.filter(numeric).slice(0, MOST.inputs), chosen = [];
      s.values.forEach(function (v, c) { if (v !== null && c < MOST.ranked) chosen.push(c); });
      var own = ranks(chosen.map(function (c) { return s.values[c]; })), places = inputs.map(function (_, i) { return i; });
      var follows = figure(s.title + ': correlation with the inputs', {x: {label: '', log: 0}, y: {label: 'rank correlation', log: 0, low: -1, high: 1},
        names: inputs.map(function (a) { return a.label; }),
        curves: [bars(places, inputs.map(function (a) {
          return correlation(own, ranks(chosen.map(function (c) { return a.values[point(c, a.dimension)]; })));
        }), 0.7)]});
      return histogram(s).concat(inputs.length ? [follows] : [], {folded: s.title + ' over each input', figures: inputs.map(function (a) {
        return dots(s.title + ' over ' + a.label, s, label(a), scaled(a.values, a));
      })});
    }
    /* Draws a scalar if a figure can show it; the tables below show the others. */
    function drawn(s) {
      var x = mainAxis(-1);
      if (data.sample) return sample(s);
      if (!x) return [dots(s.title, s, 'case', s.values.map(function (_, c) { return 1 + c * (dimensions === 1 ? data.steps[0] : 1); }))];
      var number = count / data.lengths[x.dimension], y = mainAxis(x.dimension), rows = y ? data.lengths[y.dimension] : 0;
      var isMap = rows >= 4 && (number > MOST.lines || number === 1 || rows > MOST.lines / 2);
      if (data.tabled && (isMap ? number / rows > MOST.maps : number > MOST.lines)) return [];
      return isMap ? maps(s, x, y) : lines(s, x);
    }
    data.axes.forEach(function (a) { a.values = Array.from(figures.unpack(a.values), function (v) { return isFinite(v) ? v : null; }); });
    var main = mainAxis(-1), speeds = main && (main.si === 'Hz' || main.si === 'rad/s'), errors = [], rest = [];
    if (!data.study || (data.described && !main && !data.sample)) return []; /* case numbers would be a meaningless axis */
    Object.keys(data.scalars).forEach(function (name) {
      var of = data.outputs[name], values = scaled(figures.unpack(data.scalars[name]), of), s = {of: of, title: of.stage + ': ' + of.label, values: values};
      if (!(most(values) > least(values))) return; /* constant scalars are in the table of verdicts */
      Array.prototype.push.apply(speeds && /^dte_/.test(of.output) ? errors : rest, drawn(s));
    });
    return [{title: 'Transmission error against speed', figures: errors}, {title: 'Over what is varied', figures: rest}];
  }

  /* Fields of the contact at an instant, which a slider moves. The `values` of a stage are unpacked; `other` is the other flank, which
   * lies a film thickness above the rough one. `live` of a figure names the field and the stage of each curve. */
  function instants(data) {
    var stages = data.fields.filter(function (m) { return m.values.pressure && m.values.film; }).slice(0, MOST.stages);
    if (!stages.length) return [];
    stages.forEach(function (m) {
      m.of = function (field) { return data.outputs[m.stage + '.' + field]; };
      m.x = scaled(figures.unpack(m.x), m.place ? data.outputs[m.place] : {factor: 1, offset: 0});
      m.at = scaled(figures.unpack(m.at), m.time ? data.outputs[m.time] : {factor: 1, offset: 0});
      Object.keys(m.values).forEach(function (field) {
        var by = stages[0].of(field) || m.of(field);
        m.values[field] = figures.unpack(m.values[field]).map(function (v) { return v * by.factor + by.offset; });
      });
      if (m.values.roughness)
        m.values.other = m.values.roughness.map(function (r, i) { return r + m.values.film[i] * stages[0].of('roughness').factor / stages[0].of('film').factor; });
    });
    var first = stages[0], x0 = Infinity, x1 = -Infinity, film = 0, start = 0, peak = -Infinity;
    function range(field) {
      return stages.reduce(function (r, m) {
        (m.values[field] || []).forEach(function (v) { if (isFinite(v)) r = [Math.min(r[0], v), Math.max(r[1], v)]; });
        return r;
      }, [Infinity, -Infinity]);
    }
    stages.forEach(function (m) {
      var p = m.values.pressure, high = 0;
      p.forEach(function (v) { if (v > high) high = v; });
      for (var k = 0; k < m.frames; k++) {
        var top = k * m.cells;
        for (var i = k * m.cells; i < (k + 1) * m.cells; i++) {
          if (p[i] > p[top]) top = i;
          if (p[i] > 0.01 * high) { x0 = Math.min(x0, m.x[i % m.cells]); x1 = Math.max(x1, m.x[i % m.cells]); }
        }
        film = Math.max(film, m.values.film[top]); /* the gap is wide away from the middle of the contact */
        if (m === first && p[top] > peak) { peak = p[top]; start = k; }
      }
    });
    var room = 0.2 * (x1 - x0), list = [];
    function panel(title, words, fields, low, high, log) {
      var of = first.of(fields[0][0]) || stages.map(function (m) { return m.of(fields[0][0]); }).filter(Boolean)[0];
      var made = figure(title, {class: 'live', x: {label: labelled(first.place ? 'position in the contact' : 'cell of the contact', first.place ? data.outputs[first.place].unit : ''),
        log: 0, low: x0 - room, high: x1 + room}, y: {label: labelled(words, of.unit), log: log ? 1 : 0, low: low, high: high}});
      fields.forEach(function (field) {
        stages.forEach(function (m, k) {
          var values = m.values[field[0]];
          if (!values || (field[0] === 'asperity_pressure' && !(range(field[0])[1] > 0))) return;
          made.curves.push(Object.assign(line(field[1] ? m.stage + ': ' + field[1] : m.stage, made.curves.length, made.curves.length, m.x,
            m.x.map(function () { return null; })), {live: [field[0], k]}));
        });
      });
      list.push(made);
    }
    panel('Pressure', 'pressure', [['pressure', ''], ['asperity_pressure', 'of asperities']], 0, 1.05 * range('pressure')[1]);
    var h = range('film'), decades = h[0] > 0 && film > 30 * h[0]; /* so that the loaded film is visible beside that at contact loss */
    panel('Film', 'film thickness', [['film', '']], decades ? Math.max(h[0], 1e-4 * film) / 1.5 : 0, 3 * film, decades);
    var r = range('roughness'), t = range('temperature'), rough = first.of('roughness');
    if (r[1] > r[0]) /* the other flank, smooth and deformed, is drawn a film thickness above the rough one */
      panel('Flanks', 'height', [['roughness', 'heights of both flanks'], ['other', 'other side of the film']], r[0] - 0.2 * (r[1] - r[0]),
        r[1] + 2 * film * rough.factor / first.of('film').factor);
    if (t[1] > t[0]) panel('Temperature', 'mean across the film', [['temperature', '']], t[0], t[1] + 0.05 * (t[1] - t[0]));
    return [{title: 'Pressure and film in the contact', stages: stages, start: start, figures: list,
      time: first.time ? data.outputs[first.time] : {unit: '', label: 'instant'},
      note: first.frames + ' of ' + first.instants + ' instants. The film is cut off above three times its central thickness.'}];
  }

  function placed(at, list) {
    return list.filter(function (s) { return s.figures.length; }).map(function (s) { return Object.assign({at: at}, s); });
  }
  return {sections: function (data) {
    return placed('over', overCases(data)).concat(placed('along', atlases(data).concat(seriesOf(data), instants(data))));
  }};
})();
