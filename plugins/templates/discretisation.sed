# the example becomes a template: it gets the new plugin's ID, and its literature is removed
s#discretisation/penalty#@ID@#
s#^ \* A discretisation of the film by somebody outside#\ * @ID@: a discretisation of the film#
/\.bibtex = /,/}}",/c\
    .bibtex = "",
