# Rows of fields as text, for awk. Source it.

# field DIR STAGE OUTPUT POSITIONS NAME: writes DIR/STAGE-OUTPUT.csv from a field over t x x that stands
# in DIR/STAGE.OUTPUT.npy: the first row is x, the others those nearest to the roll angles that stand
# third in the lines of the file POSITIONS which begin with NAME; the first column is their roll angle
field() {
    npy=$1/$2.$3.npy
    columns=$(($(wc -l < "$1/$2-x.csv") - 1))
    # the numbers follow a header whose length stands in bytes 8 and 9
    start=$((10 + $(od -A n -t u2 -j 8 -N 2 "$npy")))
    {
        tail -n +2 "$1/$2-x.csv" | cut -d, -f1 | paste -s -d, | sed 's/^/roll_angle [rad] \\ x [m],/'
        awk -F, -v name="$5" '
            FNR == NR { if (split($0, word, " ") && word[1] == name) { angle[++n] = word[3]; best[n] = 1e9 } next }
            FNR == 1 { for (c = 1; c <= NF && $c !~ /^roll_angle /; c++); next }
            {
                for (k = 1; k <= n; k++) {
                    d = $c < angle[k] ? angle[k] - $c : $c - angle[k]
                    if (d < best[k]) { best[k] = d; row[k] = FNR - 2; at[k] = $c }
                }
            }
            END { for (k = 1; k <= n; k++) print row[k], at[k] }' "$4" "$1/$2.csv" |
            while read -r row angle; do
                od -A n -v -t f8 -w$((8 * columns)) -j $((start + 8 * columns * row)) -N $((8 * columns)) "$npy" |
                    sed "s/  */,/g; s/^/$angle/"
            done
    } > "$1/$2-$3.csv"
}
