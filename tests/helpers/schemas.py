"""Schemas of FMI, SSP and SSP Traceability that packages of PyPI hold, and what they find."""

from __future__ import annotations

import io
from pathlib import Path

import fmpy
import pytest
import xmlschema
from lxml import etree

FMI_3 = Path(fmpy.__file__).parent / "schema" / "fmi3"
SSP_1 = Path(fmpy.__file__).parent / "ssp" / "schema"
_PYSSP = Path(pytest.importorskip("pyssp_standard").__file__).parent / "resources"
SSP_2 = _PYSSP / "ssp2"
SRMD = _PYSSP / "SRMD11.xsd"
_XLINK = """<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema"
    targetNamespace="http://www.w3.org/1999/xlink">
  <xs:attribute name="type"/> <xs:attribute name="href" type="xs:anyURI"/>
  <xs:attribute name="role"/> <xs:attribute name="arcrole"/> <xs:attribute name="title"/>
  <xs:attribute name="label"/> <xs:attribute name="from"/> <xs:attribute name="to"/>
  <xs:attribute name="show"/> <xs:attribute name="actuate"/>
</xs:schema>"""  # the W3C's lies on its server


def complaints(schema: Path, content: bytes) -> list[str]:
    """Return what a schema (XSD 1.0) finds wrong."""
    validator = etree.XMLSchema(etree.parse(str(schema)))
    validator.validate(etree.fromstring(content))
    return [str(one) for one in validator.error_log]


def srmd_complaints(content: bytes) -> list[str]:
    """Return what the schema of SRMD (XSD 1.1) finds wrong."""
    locations = [("http://www.w3.org/1999/xlink", _XLINK)]
    schema = xmlschema.XMLSchema11(str(SRMD), locations=locations, allow="local")
    return [str(one) for one in schema.iter_errors(io.BytesIO(content))]
