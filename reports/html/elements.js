// Makes an element with properties and content; a text in the content is text, never markup.
const element = (name, properties = {}, ...content) => {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...content);
  return made;
};
