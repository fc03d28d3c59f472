"""What a document was found to show, in plain words that records of items fill and support."""

from .pages import findings_page, leading_page
from .support import Told, findings_of, leading, tell

__all__ = ["Told", "findings_of", "findings_page", "leading", "leading_page", "tell"]
