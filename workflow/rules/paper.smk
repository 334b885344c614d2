# In: tables, trials, figures with their captions, the article's source. Out: the article, whose
# numbers are looked up in them while it is set. It is about the study of config.yaml; of another
# one it can be asked for by name, and fails where that lacks what it quotes.
from curvlib.claims.cell import NINE, SEVEN

ARTICLE = Path(HOUSE, "paper/paper.typ")
CAPTIONS = Named(
    {figure: caption(figure) for figure in [*PICTURES, *ERROR_FIGURES, *CLAIM_FIGURES]}
)


rule paper:
    input:
        rules.explanations.output,
        rules.accuracy.output,
        rules.claims.output,
        rules.figures.input,
        NOISE,
        LIBRARY,
        [file for kind in ("typ", "bib") for file in sorted(ARTICLE.parent.glob(f"*.{kind}"))],
        sorted(set(CAPTIONS.values())),
        citation=f"{HOUSE}/CITATION.cff",
    output:
        reported(study.results / "paper/paper.pdf", HOLDS, "paper"),
    log:
        study.results / "logs/paper.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        article=ARTICLE,
        results=study.results,
        library=study.library,
        meshes=Rows(mesh_files(*mesh)[0] for mesh in MESHES),
        captions=CAPTIONS,
        estimators=ESTIMATORS,
        surfaces=SURFACES,
        quoted=Named(
            {
                "surfaces": SEVEN,
                "estimators": NINE,
                "resolutions": study.resolutions,
                "cuts": list(dict.fromkeys(diagonal for diagonal, _ in CUTS)),
            }
        ),
        code=code("paper", *MODULES),
    script:
        "../scripts/paper.py"
