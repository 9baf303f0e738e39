"""Tables that scripts write into a page between marks that name the script, or as a file of their own."""
import argparse
import pathlib


def command(doc, page, name, table, argv=None):
    """The command line of such a script: `OUT [--write]`, and `table(OUT)` printed or put into `page`."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path, help="folder that holds the decks' outputs")
    parser.add_argument("--write", action="store_true", help=f"into {page.parent.name}/{page.name}")
    args = parser.parse_args(argv)
    if not args.out.is_dir():
        raise SystemExit(f"{args.out}: no such folder")
    put(page, name, table(args.out), args.write)


def put(page, name, text, write):
    """Prints `text`, or replaces with it what stands between the marks of `name` in the file `page`; the whole file if None."""
    if not write:
        print(text, end="")
        return
    if name is None:
        page.write_text(text)
        return
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    old = page.read_text()
    if old.count(begin) != 1 or old.count(end) != 1:
        raise SystemExit(f"{page}: needs the lines {begin} and {end}, once each")
    before, rest = old.split(begin)
    page.write_text(f"{before}{begin}\n{text}{end}{rest.split(end)[1]}")
