# Prints the guide's table "What a doubt means" as C initialisers: {name, sentences}.
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
