"""The instrument that counts operations, under the name that the documents know."""

from ..instrument import Cost, Instrument

__all__ = ["Cost", "Instrument"]
