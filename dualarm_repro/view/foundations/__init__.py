"""Tables and figures of the foundations part of the book, computed when a page is built."""
