# awk -f two_parts.awk MODEL.obj: the model (v and f of three numbers), and the same once more nine units beside it.
{ print }
$1 == "v" { ++n; place[n] = "v " $2 + 9 " " $3 " " $4 }
$1 == "f" { face[++m] = $2 " " $3 " " $4 }
END {
    for (i = 1; i <= n; ++i) print place[i]
    for (i = 1; i <= m; ++i) {
        split(face[i], c, " ")
        print "f", c[1] + n, c[2] + n, c[3] + n
    }
}
