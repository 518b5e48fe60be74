# Puts new tables into a page, in place of those with the same first line; those in a list keep their
# indentation.
#   awk -f splice.awk TABLES PAGE
NR == FNR {
    if ($0 !~ /^\|/) { title = ""; next }
    if (title == "") { title = $0; rows[title] = 0 }
    row[title, ++rows[title]] = $0
    next
}
{ line = $0; sub(/^ */, "", line) }
old && line ~ /^\|/ { next }
{ old = 0 }
line in rows {
    indent = substr($0, 1, length($0) - length(line))
    for (i = 1; i <= rows[line]; i++) print indent row[line, i]
    old = 1; used++
    next
}
{ print }
END {
    for (title in rows) wanted++
    if (used != wanted) { print "no place for a table" > "/dev/stderr"; exit 1 }
}
