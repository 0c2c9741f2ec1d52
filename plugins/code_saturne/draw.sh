#!/usr/bin/env bash
# Draws where particles stuck on the floor, as seen from above: draw.sh impacts.csv... > deposit.svg
exec awk -F, '
BEGIN {
    left = 50; top = 30; scale = 2000; length_ = 0.4; width = 0.02; w = length_ * scale; h = 4 * width * scale
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" font-family=\"sans-serif\" font-size=\"12\">\n", w + 80, h + 90
    printf "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n"
    for (i = 0; i <= 8; i++) printf "<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">%d</text>\n", left + i * w / 8, top + h + 16, 50 * i
    for (i = 0; i <= 2; i++) printf "<text x=\"%g\" y=\"%g\" text-anchor=\"end\">%d</text>\n", left - 6, top + h - i * h / 2 + 4, 10 * i
    printf "<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">x (mm), the air comes from the left; z (mm) is drawn four times as large</text>\n", left + w / 2, top + h + 36
    printf "<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" stroke=\"black\"/>\n", left, top, w, h
}
FNR > 1 && $1 == "floor" && $2 == "capture" {
    n++
    printf "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"#b5651d\" fill-opacity=\"0.6\"/>\n", left + $5 * scale, top + h - $7 * 4 * scale, $8 * 4e4
}
END {
    printf "<text x=\"%g\" y=\"20\">%d copper spheres of 50 um (sd 10 um) that stuck on the glass floor of a channel, air at 2 m/s</text>\n</svg>\n", left, n
}' "$@"
