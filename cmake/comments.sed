# Makes plain comments Doxygen's, and their text harmless to it.
/^ *\/\/|^ *\/\*|^ \*/ {
  s/[\\@]/\\&/g
  s/</\&lt;/g
  s/>/\&gt;/g
}
# A file's own comment, which opens it.
1s|^// |/// \\file\n/// |
1s|^/\* |/** \\file\n * |
# Titles are of nothing.
/^\/[\/*] ----/b
# What follows on a value's comment, far to the right, before what stands over a declaration.
s|^( {16,})// |\1///< |
s|^( *)// ?|\1/// |
s|^( *)/\* |\1/** |
s|([^ ]) +// (.*)|\1  ///< \2|
s|([^ ]) +/\* ([^*]*)|\1 /**< \2|
