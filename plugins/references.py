#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""references.py FILE.bib HEADER: defines in HEADER a string BIB_key for each entry @type{key, ...} of FILE."""
import json
import re
import sys


def entries(text):
    """The text of each entry, from its @ to the brace that closes it."""
    for start in re.finditer(r"^@", text, re.M):
        depth = 0
        for end in range(start.start(), len(text)):
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            if text[end] == "}" and depth == 0:
                break
        yield text[start.start() : end + 1]


source, header = sys.argv[1:]
with open(source, encoding="utf-8") as file:
    found = list(entries(file.read()))
with open(header, "w", encoding="utf-8") as file:
    for entry in found:
        key = re.match(r"@\w+\{([^,\s]+),", entry).group(1)
        print(f"#define BIB_{re.sub(r'[^A-Za-z0-9]', '_', key)} {json.dumps(entry, ensure_ascii=False)}", file=file)
