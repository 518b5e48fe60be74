#!/bin/sh
# Joins the modules of the plotting library that the pages need into one script, which defines `vega`, with the licence.
#   library.sh FOLDER LICENCE
set -eu
printf '/*\n%s\n*/\n' "$(cat "$2")"
cd "$1"
echo '(function () { "use strict"; var make = {}, made = {};'
echo 'function need(n) { if (!made[n]) { var m = {exports: {}}; made[n] = m.exports; make[n](m.exports, m, need); } return made[n]; }'
for module in util time format event-selector expression statistics dataflow canvas loader scale \
    scenegraph selection functions runtime parser transforms view-transforms encode view interpreter; do
    name=vega-$module
    [ $module != selection ] || name=vega-selections
    printf 'make["%s"] = function (exports, module, require) {' "$name"
    sed 's|^//# sourceMappingURL.*||' "vega-$module.min.js"
    echo '};'
done
cat <<'END'
["vega-transforms", "vega-view-transforms", "vega-encode"].forEach(function (n) {
  Object.assign(need("vega-dataflow").transforms, need(n));
});
self.vega = {View: need("vega-view").View, parse: need("vega-parser").parse, scheme: need("vega-scale").scheme,
  interpreter: need("vega-interpreter").expressionInterpreter};
}());
END
