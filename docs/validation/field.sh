# Fields as rows of text, for awk. Source it.

# field DIR STAGE OUTPUT: writes DIR/STAGE-OUTPUT.csv of a field over t x x, which stands in
# DIR/STAGE.OUTPUT.npy: the first row is x, the first column the roll angle
field() {
    npy=$1/$2.$3.npy
    columns=$(($(wc -l < "$1/$2-x.csv") - 1))
    # the numbers follow a header whose length stands in bytes 8 and 9
    od -A n -v -t f8 -w$((8 * columns)) -j $((10 + $(od -A n -t u2 -j 8 -N 2 "$npy"))) "$npy" |
        awk -v ends="$1/$2.csv" -v xs="$1/$2-x.csv" '
            BEGIN {
                getline line < ends
                n = split(line, name, ",")
                for (k = 1; k <= n && name[k] !~ /^roll_angle /; k++);
                getline line < xs
                printf "roll_angle [rad] \\ x [m]"
                while ((getline line < xs) > 0) { split(line, cell, ","); printf ",%s", cell[1] }
                print ""
            }
            {
                getline line < ends
                split(line, cell, ",")
                printf "%s", cell[k]
                for (i = 1; i <= NF; i++) printf ",%.10g", $i
                print ""
            }' > "$1/$2-$3.csv"
}
