# Puts new tables into a page, in place of those with the same first line.
#   awk -f splice.awk TABLES PAGE
NR == FNR {
    if ($0 !~ /^\|/) { title = ""; next }
    if (title == "") title = $0
    table[title] = table[title] $0 "\n"
    next
}
skip && /^\|/ { next }
{ skip = 0 }
$0 in table { printf "%s", table[$0]; skip = 1; used++; next }
{ print }
END {
    for (title in table) wanted++
    if (used != wanted) { print "no place for a table" > "/dev/stderr"; exit 1 }
}
