# Makes plain comments Doxygen's, and their text harmless to it.
# Of a comment that begins its line, what is indented after an empty line is code, up to the next line that is not. It
# stands between \x01 and \x02 until brackets are harmless; what is known of the line before is held.
/^( \*|\/\/)   / {
  x
  s/^empty$/code/
  t begin
  x
  b known
  :begin
  x
  s/^( \*|\/\/) /&\x01pre\x02/
  b known
}
x
/^code$/ {
  x
  s/^( \*|\/\/)/& \x01\/pre\x02/
  t ended
  i /// </pre>
  :ended
  x
}
s/.*//
x
/^( \*|\/\/)$/ {
  x
  s/.*/empty/
  x
}
:known
/^ *\/\/|^ *\/\*|^ \*/ {
  s/[\\@]/\\&/g
  s/("[^"\\]*)\\\\([^"]*")/\1\\\2/g
  s/</\&lt;/g
  s/>/\&gt;/g
}
s/`([^`]+)`/<tt>\1<\/tt>/g
y/\x01\x02/<>/
# What follows the end of a condition is of nothing.
/^#endif/b
# A file's own comment, which opens it.
1s|^// |// \\file\n/// |
1s|^/\* |/** \\file\n * |
# Titles are of nothing.
/^\/[\/*] ----/b
# What follows on a value's comment, far to the right, before what stands over a declaration.
s|^( {16,})// |\1///< |
s|^( *)// ?|\1/// |
s|^( *)/\* |\1/** |
# In comments, nothing more is one.
/^ *\/\/\/|^ \*/b
s|([^ ]) +// (.*)|\1  ///< \2|
s|([^ ]) +/\* ([^*]*)|\1 /**< \2|
