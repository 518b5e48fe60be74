# The rows of the guide's table on what a doubt means, as C: each name with its sentences.
/^### / { inside = $0 == "### What a doubt means" }
inside && /^\| `/ {
  split($0, cells, " \\| ")
  sub(/^\| /, "", cells[1])
  text = cells[2]
  sub(/ \|$/, "", text)
  gsub(/`/, "", text)
  gsub(/[\\"]/, "\\\\&", text)
  count = split(cells[1], names, /, /)
  for (i = 1; i <= count; i++) {
    gsub(/[`.]/, "", names[i])
    printf "{\"%s\", \"%s\"},\n", names[i], text
  }
}
