// The search leaves numbers out. A number with a point, or of three digits, is looked for as a word of its own,
// under which the pages of items are in the index (tools/sphinx_ext/item_pages.py).
var splitQuery = (query) => {
  const number = /\d+[.,]\d+|\d{3,}/g;
  const found = (query.match(number) || []).map((text) => "number_" + text.replace(/[.,]/, "_"));
  const words = query.replace(number, " ").split(/[^\p{Letter}\p{Number}_\p{Emoji_Presentation}]+/gu);
  return [...found, ...words.filter((word) => word)];
};
