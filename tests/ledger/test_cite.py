"""Citations are parsed by the tools they are for, and keep original titles and names."""

import codecs

import pytest
from pybtex.database import parse_string

from dualarm_repro.errors import DataFileError, UnknownNameError
from dualarm_repro.ledger.cite import bibtex, cite, csl
from dualarm_repro.ledger.schema import Document, load_paper

from .toy import YAML, toy_registry

#: Not known to the decoder.
SIGNS = {
    r"\textbraceleft{}": "{",
    r"\textbraceright{}": "}",
    r"\textasciicircum{}": "^",
    r"\$": "$",
}


def entries(text):
    return parse_string(text, "bibtex").entries


def plain(text):
    """What a TeX reader sees."""
    for written, sign in SIGNS.items():
        text = text.replace(written, sign)
    parts = text.split(r"\textbackslash{}")
    return "\\".join(codecs.decode(part, "ulatex") for part in parts)


def test_result_and_document(tmp_path):
    toy = toy_registry(tmp_path)
    text = cite(toy, "toy.claim_area", "bibtex", "reproduced")
    result, document = entries(text).values()
    assert result.key == "dualarm_repro_toy_claim_area"
    assert result.fields["note"].startswith("Verdict: reproduced.")
    assert str(document.persons["author"][0]) == "Doe, Jane"
    assert "doi" not in text.lower()
    result, document = cite(toy, "toy.claim_area", "csl-json", "reproduced")
    assert result["type"] == "software"
    assert document["author"] == [{"family": "Doe", "given": "Jane"}]
    with pytest.raises(UnknownNameError, match="bibtex, csl-json"):
        cite(toy, "toy.claim_area", "ris", "reproduced")
    with pytest.raises(UnknownNameError, match=r"toy\.nothing"):
        cite(toy, "toy.nothing", "bibtex", "reproduced")


@pytest.mark.parametrize(
    "title",
    [
        "a_b & c% of #1 for 5 $, x^2 ~ y",
        r"a back\slash, {balanced} and lone { or }",
        'He said "x" – “y”, à la Šimánek',
        "基于改进人工势场法的双机械臂避障路径规划",
    ],
)
def test_every_sign_survives_bibtex(title):
    document = Document(id="x", type="misc", title=title, title_original=title)
    found = entries(bibtex(document))["x"]
    assert plain(found.fields["title"]) == title
    assert plain(found.fields["origtitle"]) == title
    assert csl(document)["original-title"] == title


def test_types_and_names():
    people = {"authors": ["Xue, Yang", "A & B Robotics"], "authors_original": ["薛, 阳", "甲乙"]}
    common = {"id": "x", "title": "T", "language": "zh", **people}
    article = Document(type="article", journal="J", year="2020", **common)
    found = entries(bibtex(article))["x"]
    assert (found.type, found.fields["journal"], found.fields["year"]) == ("article", "J", "2020")
    assert [str(person) for person in found.persons["author"]] == [
        "Xue, Yang",
        r"{A \& B Robotics}",
    ]
    assert found.fields["nameaddon"] == "薛阳; 甲乙"
    assert found.fields["language"] == "chinese"
    made = csl(article)
    assert made["original-author"] == [{"family": "薛", "given": "阳"}, {"literal": "甲乙"}]
    assert made["issued"] == {"date-parts": [[2020]]}
    without = Document(type="article", **common)
    assert entries(bibtex(without))["x"].type == "misc"  # an article needs a journal
    assert entries(bibtex(Document(type="patent", **common)))["x"].type == "patent"


def test_documents_keep_their_original_titles_and_names(registry):
    for name, paper in registry.papers.items():
        document = paper.document
        found = entries(bibtex(document))[name]
        assert plain(found.fields["title"]) == document.title
        if "title" not in document.unknown:
            assert found.fields["origtitle"] == document.title_original
        assert len(document.authors_original) == len(document.authors)
        people = [str(person) for person in found.persons.get("author", [])]
        assert people == document.authors


def test_original_names_are_of_the_same_people(tmp_path):
    path = tmp_path / "toy.yaml"
    wrong = 'authors: ["Doe, Jane"], authors_original: ["甲, 乙", "丙, 丁"]'
    path.write_text(YAML.replace('authors: ["Doe, Jane"]', wrong))
    with pytest.raises(DataFileError, match="one name for each of authors"):
        load_paper(path)
