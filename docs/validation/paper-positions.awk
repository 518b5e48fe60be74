# Lists the ten positions of each point, and those of loads that jump at once: name, letter, roll angle in rad.
BEGIN {
    if (failed) exit 1
    for (q = 1; q <= 3; q++)
        for (i = 1; i <= 10; i++)
            printf "%s %s %.17g\n", points[q], substr("ABCDEFGHIJ", i, 1), where[points[q], substr("ABCDEFGHIJ", i, 1)] / deg
    aim("I")
    at["G"] = lpstc + soon
    for (letter in at) printf "step %s %.17g\n", letter, at[letter] / deg
}
